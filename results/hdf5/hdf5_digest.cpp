#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <span>
#include <string_view>

#include "results/hdf5/hdf5.hpp"
#include "results/hdf5/hdf5_dataset.hpp"
#include "results/hdf5/hdf5_handle.hpp"
#include "results/util/digest.hpp"

namespace ridgeloc::results::hdf5 {
namespace {

/// Whether a dataset takes part in a digest.
bool is_covered(std::string_view path, File::Extent extent) {
  return !path.starts_with("/provenance/") && (extent == File::Extent::All || !path.starts_with("/trials/"));
}

std::string hexadecimal(const Digest64& digest) {
  return fmt::format("{:016x}", digest.value());
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

struct Object {
  std::string path;
  bool is_dataset;
  bool has_attributes;
};

/// The root's members, with all below them; those of /trials, which can be many, only if they are asked for.
std::vector<Object> objects_of(hid_t file, const std::filesystem::path& name, File::Extent extent) {
  std::vector<std::string> members;
  const auto keep_member = [](hid_t, const char* member, const H5L_info_t*, void* target) -> herr_t {
    static_cast<std::vector<std::string>*>(target)->push_back(fmt::format("/{}", member));
    return 0;
  };
  if (H5Literate(file, H5_INDEX_NAME, H5_ITER_INC, nullptr, keep_member, &members) < 0)
    fail("list", name, "its objects");

  struct Visit {
    const std::string& member;
    std::vector<Object> objects;
  };
  const auto keep = [](hid_t, const char* path, const H5O_info_t* info, void* target) -> herr_t {
    auto& [member, objects] = *static_cast<Visit*>(target);
    const std::string full = std::string_view(path) == "." ? member : fmt::format("{}/{}", member, path);
    objects.push_back({full, info->type == H5O_TYPE_DATASET, info->num_attrs > 0});
    return 0;
  };
  std::vector<Object> objects;
  for (const std::string& member : members) {
    require_own_link(file, name, member);
    if (extent == File::Extent::Totals && member == "/trials") continue;
    Visit visit{member, {}};
    if (H5Ovisit_by_name2(file, member.c_str(), H5_INDEX_NAME, H5_ITER_INC, keep, &visit,
                          H5O_INFO_BASIC | H5O_INFO_NUM_ATTRS, H5P_DEFAULT) < 0)
      fail("list", name, member);
    std::ranges::move(visit.objects, std::back_inserter(objects));
  }
  return objects;
}

std::vector<std::string> attributes_of(hid_t file, const std::filesystem::path& name, const std::string& object) {
  std::vector<std::string> attributes;
  const auto keep = [](hid_t, const char* attribute, const H5A_info_t*, void* target) -> herr_t {
    static_cast<std::vector<std::string>*>(target)->emplace_back(attribute);
    return 0;
  };
  if (H5Aiterate_by_name(file, object.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, keep, &attributes, H5P_DEFAULT) < 0)
    fail("list", name, "the attributes of " + object);
  return attributes;
}

std::string digest_of(const Dataset& dataset, Hash hash) {
  if (dataset.type() == Type::Text) return digest_of(dataset.read_text(), hash);
  const std::uint64_t elements = dataset.elements();
  // A dataset of one dimension piece by piece, chunk by chunk where it has chunks: memory that is in use already is
  // faster than that of a whole column.
  const std::uint64_t most = dataset.shape().size() == 1 ? chunk_values : std::max(elements, std::uint64_t{1});
  std::vector<std::byte> piece(std::min(elements, most) * size_of(dataset.type()));
  Sha256 sha;
  Digest64 xxh3;
  for (std::uint64_t first = 0; first < elements; first += most) {
    const std::uint64_t count = std::min(most, elements - first);
    dataset.read(dataset.type(), piece.data(), first, count);
    const auto bytes = std::span<const std::byte>(piece).first(count * size_of(dataset.type()));
    hash == Hash::Sha256 ? sha.update(bytes) : xxh3.update(bytes);
  }
  return hash == Hash::Sha256 ? sha.hex() : hexadecimal(xxh3);
}

template <typename T>
std::string digest_of_numbers(const std::vector<T>& values) {
  return sha256_hex(std::as_bytes(std::span(values)));
}

}  // namespace

std::string digest_of(std::span<const std::byte> values, Hash hash) {
  if (hash == Hash::Sha256) return sha256_hex(values);
  Digest64 digest;
  digest.update(values);
  return hexadecimal(digest);
}

std::string digest_of(const std::vector<std::string>& values, Hash hash) {
  std::vector<std::byte> joined;
  for (const std::string& value : values) {
    const std::uint64_t size = value.size();
    std::ranges::copy(std::as_bytes(std::span(&size, 1)), std::back_inserter(joined));
    std::ranges::copy(std::as_bytes(std::span(value)), std::back_inserter(joined));
  }
  return digest_of(joined, hash);
}

void File::record(const std::string& path, Type type, const Shape& shape, const std::string& digest) {
  manifest_[path] = manifest_line(path, type, shape, digest);
}

std::string File::written_digest(Extent extent) const {
  return digest_of(manifest_, extent);
}

std::string File::content_digest(Extent extent) const {
  std::map<std::string, std::string> manifest;
  for (const Object& object : objects_of(id_, path_, extent)) {
    const std::string& path = object.path;
    if (!object.is_dataset || !is_covered(path, extent)) continue;
    const Dataset dataset(id_, path_, path);
    manifest[path] = manifest_line(path, dataset.type(), dataset.shape(), digest_of(dataset, hash_));
  }
  return digest_of(manifest, extent);
}

std::string File::attributes_digest() const {
  std::set<std::string> lines;
  for (const std::string& name : attributes_of(id_, path_, "/"))
    if (!name.ends_with("_sha256")) lines.insert(attribute_line("/", name));
  for (const Object& object : objects_of(id_, path_, Extent::Totals)) {
    if (!object.has_attributes) continue;
    for (const std::string& name : attributes_of(id_, path_, object.path))
      lines.insert(attribute_line(object.path, name));
  }
  Sha256 sha;
  for (const std::string& line : lines) sha.update(line);
  return sha.hex();
}

std::string File::attribute_line(const std::string& object, const std::string& name) const {
  const std::string path = fmt::format("{}@{}", object, name);
  const Handle attribute{H5Aopen_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose, "read",
                         path_, path};
  const Handle type{H5Aget_type(attribute), H5Tclose, "read", path_, path};
  if (H5Tis_variable_str(type) > 0) {
    const std::vector<std::string> texts = texts_attribute(object, name);
    return manifest_line(path, Type::Text, {texts.size()}, digest_of(texts, Hash::Sha256));
  }
  if (H5Tequal(type, H5T_STD_U64LE) > 0) {
    const std::vector<std::uint64_t> numbers = numbers_attribute(object, name);
    return manifest_line(path, Type::U64, {numbers.size()}, digest_of_numbers(numbers));
  }
  if (H5Tequal(type, H5T_IEEE_F64LE) > 0) {
    const double value = real_attribute(object, name);
    return manifest_line(path, Type::F64, {1}, digest_of_numbers<double>({value}));
  }
  return {};
}

}  // namespace ridgeloc::results::hdf5
