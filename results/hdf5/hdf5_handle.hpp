#pragma once
// Internal to the HDF5 layer: the only header that includes <hdf5.h>.

#include <hdf5.h>

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/hdf5/hdf5.hpp"

namespace ridgeloc::results::hdf5 {

/// Throws core::IoError "cannot <action> <object> in <file>: <HDF5's innermost reason>", and std::bad_alloc where that
/// was a lack of memory.
[[noreturn]] void fail(std::string_view action, const std::filesystem::path& file, std::string_view object);

/// Throws core::InputError: an object of a file, or its values, would be read from another file.
[[noreturn]] void refuse_foreign(const std::filesystem::path& file, std::string_view object);

/// Calls `refuse_foreign` if the last link of a path, which must exist, is not that of an object of the file itself.
void require_own_link(hid_t file, const std::filesystem::path& name, const std::string& path);

/// The same for every link of a path; a path that ends early is let pass.
void require_own(hid_t file, const std::filesystem::path& name, const std::string& path);

/// Owns an HDF5 identifier.
class Handle {
 public:
  using Close = herr_t (*)(hid_t);

  /// Throws as `fail` does if the call that made the identifier failed.
  Handle(hid_t id, Close closer, std::string_view action, const std::filesystem::path& file, std::string_view object)
      : id_(id), close_(closer) {
    if (id_ < 0) fail(action, file, object);
  }
  ~Handle() {
    if (id_ >= 0) close_(id_);
  }
  Handle(Handle&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Handle& operator=(Handle&&) = delete;

  /// Closes now: values may reach the disk only here. Throws as `fail` does.
  void close(std::string_view action, const std::filesystem::path& file, std::string_view object) {
    if (close_(std::exchange(id_, H5I_INVALID_HID)) < 0) fail(action, file, object);
  }

  operator hid_t() const { return id_; }  // NOLINT(google-explicit-constructor): stands in for the identifier

 private:
  hid_t id_;
  Close close_;
};

/// Memory type of variable-length UTF-8 strings.
Handle text_type(const std::filesystem::path& file);

/// Hexadecimal digits of the hash of values, of strings each as its length (64 bits) and its bytes.
std::string digest_of(std::span<const std::byte> values, Hash hash);
std::string digest_of(const std::vector<std::string>& values, Hash hash);

}  // namespace ridgeloc::results::hdf5
