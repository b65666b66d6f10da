#include "results/hdf5/hdf5_handle.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace ridgeloc::results::hdf5 {
namespace {

/// The system's own words within HDF5's description of a failed read or write, else its first line.
std::string essence_of(const std::string& description) {
  constexpr std::string_view opening = "error message = '";
  const std::size_t quote = description.find(opening);
  if (quote == std::string::npos) return description.substr(0, description.find('\n'));
  const std::size_t begin = quote + opening.size();
  return description.substr(begin, description.find('\'', begin) - begin);
}

}  // namespace

void fail(std::string_view action, const std::filesystem::path& file, std::string_view object) {
  std::string reason;
  const auto keep_innermost = [](unsigned position, const H5E_error2_t* error, void* target) -> herr_t {
    if (position == 0 && error->desc != nullptr) *static_cast<std::string*>(target) = error->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &reason);
  reason = essence_of(reason);
  throw core::IoError(
      fmt::format("cannot {} {} in {}{}{}", action, object, file.string(), reason.empty() ? "" : ": ", reason));
}

Handle text_type(const std::filesystem::path& file) {
  Handle type{H5Tcopy(H5T_C_S1), H5Tclose, "create", file, "a string type"};
  if (H5Tset_size(type, H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0)
    fail("create", file, "a string type");
  return type;
}

}  // namespace ridgeloc::results::hdf5
