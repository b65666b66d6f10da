#include "results/hdf5/hdf5_handle.hpp"

#include <fmt/format.h>

#include <new>

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
  struct Innermost {
    std::string reason;
    bool is_memory = false;
  } innermost;
  const auto keep_innermost = [](unsigned position, const H5E_error2_t* error, void* target) -> herr_t {
    if (position != 0) return 0;
    auto& [reason, is_memory] = *static_cast<Innermost*>(target);
    if (error->desc != nullptr) reason = error->desc;
    is_memory = error->maj_num == H5E_RESOURCE && error->min_num == H5E_NOSPACE;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, keep_innermost, &innermost);
  if (innermost.is_memory) throw std::bad_alloc();
  const std::string reason = essence_of(innermost.reason);
  throw core::IoError(
      fmt::format("cannot {} {} in {}{}{}", action, object, file.string(), reason.empty() ? "" : ": ", reason));
}

void refuse_foreign(const std::filesystem::path& file, std::string_view object) {
  throw core::InputError(
      fmt::format("{}: {} is a link or lies in another file, as in no result that ridgeloc has written; it is not read",
                  file.string(), object));
}

void require_own_link(hid_t file, const std::filesystem::path& name, const std::string& path) {
  H5L_info_t info{};
  if (H5Lget_info(file, path.c_str(), &info, H5P_DEFAULT) < 0) fail("read", name, path);
  if (info.type != H5L_TYPE_HARD) refuse_foreign(name, path);
}

void require_own(hid_t file, const std::filesystem::path& name, const std::string& path) {
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const std::string link = path.substr(0, end);
    if (link == "/" || H5Lexists(file, link.c_str(), H5P_DEFAULT) <= 0) return;
    require_own_link(file, name, link);
    if (end == std::string::npos) return;
  }
}

Handle text_type(const std::filesystem::path& file) {
  Handle type{H5Tcopy(H5T_C_S1), H5Tclose, "create", file, "a string type"};
  if (H5Tset_size(type, H5T_VARIABLE) < 0 || H5Tset_cset(type, H5T_CSET_UTF8) < 0)
    fail("create", file, "a string type");
  return type;
}

}  // namespace ridgeloc::results::hdf5
