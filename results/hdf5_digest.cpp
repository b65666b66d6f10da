#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string_view>

#include "results/digest.hpp"
#include "results/hdf5.hpp"
#include "results/hdf5_handle.hpp"

namespace ridgeloc::results::hdf5 {
namespace {

/// Whether a dataset takes part in a digest.
bool is_covered(std::string_view path, File::Extent extent) {
  return !path.starts_with("/provenance/") && (extent == File::Extent::All || !path.starts_with("/trials/"));
}

std::string_view name_of(Type type) {
  switch (type) {
    case Type::F64:
      return "f64";
    case Type::I64:
      return "i64";
    case Type::U64:
      return "u64";
    case Type::U32:
      return "u32";
    case Type::U8:
      return "u8";
    case Type::Text:
      break;
  }
  return "text";
}

std::string manifest_line(const std::string& path, Type type, const Shape& shape, const std::string& digest) {
  return fmt::format("{} {} {} {}\n", path, name_of(type), fmt::join(shape, "x"), digest);
}

std::string digest_of(const std::map<std::string, std::string>& manifest, File::Extent extent) {
  Sha256 sha;
  for (const auto& [path, line] : manifest)
    if (is_covered(path, extent)) sha.update(line);
  return sha.hex();
}

/// Full paths of all datasets of a file.
std::vector<std::string> datasets_of(hid_t file, const std::filesystem::path& name) {
  std::vector<std::string> paths;
  const auto keep = [](hid_t, const char* path, const H5O_info_t* info, void* target) -> herr_t {
    if (info->type == H5O_TYPE_DATASET)
      static_cast<std::vector<std::string>*>(target)->push_back(fmt::format("/{}", path));
    return 0;
  };
  if (H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, keep, &paths, H5O_INFO_BASIC) < 0) fail("list", name, "its objects");
  return paths;
}

template <typename T>
std::string digest_of_values(const File& file, const std::string& path) {
  const std::vector<T> values = file.read<T>(path);
  return sha256_hex(std::as_bytes(std::span(values)));
}

}  // namespace

std::string digest_of(const std::vector<std::string>& values) {
  Sha256 sha;
  for (const std::string& value : values) {
    const std::uint64_t size = value.size();
    sha.update(std::as_bytes(std::span(&size, 1)));
    sha.update(value);
  }
  return sha.hex();
}

void File::record(const std::string& path, Type type, const Shape& shape, const std::string& digest) {
  manifest_[path] = manifest_line(path, type, shape, digest);
}

std::string File::written_digest(Extent extent) const {
  return digest_of(manifest_, extent);
}

std::string File::content_digest(Extent extent) const {
  const auto digest_of_dataset = [this](const std::string& path, Type type) {
    switch (type) {
      case Type::F64:
        return digest_of_values<double>(*this, path);
      case Type::I64:
        return digest_of_values<std::int64_t>(*this, path);
      case Type::U64:
        return digest_of_values<std::uint64_t>(*this, path);
      case Type::U32:
        return digest_of_values<std::uint32_t>(*this, path);
      case Type::U8:
        return digest_of_values<std::uint8_t>(*this, path);
      case Type::Text:
        break;
    }
    return digest_of(read_text(path));
  };
  std::map<std::string, std::string> manifest;
  for (const std::string& path : datasets_of(id_, path_)) {
    if (!is_covered(path, extent)) continue;
    const Type kind = type(path);
    manifest[path] = manifest_line(path, kind, shape(path), digest_of_dataset(path, kind));
  }
  return digest_of(manifest, extent);
}

}  // namespace ridgeloc::results::hdf5
