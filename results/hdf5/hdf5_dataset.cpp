#include "results/hdf5/hdf5_dataset.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <numeric>

#include "core/error.hpp"
#include "core/printable.hpp"

namespace ridgeloc::results::hdf5 {
namespace {

namespace fs = std::filesystem;

/// Deflate cannot shrink data by more than this factor (zlib's technical notes): an extent that would need more is
/// damage, and is refused before memory is asked for.
constexpr std::uint64_t largest_compression = 1032;
/// Bytes that one variable-length string takes in a dataset: length, address of the heap, index.
constexpr std::uint64_t text_reference_bytes = 16;

Type type_of_dataset(hid_t dataset, const fs::path& name, const std::string& path) {
  const Handle element{H5Dget_type(dataset), H5Tclose, "read", name, path};
  if (H5Tget_class(element) == H5T_STRING && H5Tis_variable_str(element) > 0) return Type::Text;
  for (const Type type : {Type::F64, Type::I64, Type::U64, Type::U32, Type::U8})
    if (H5Tequal(element, numeric_type(type)) > 0) return type;
  throw core::IoError(fmt::format("cannot read {} in {}: its type is not of the file format", path, name.string()));
}

/// Size per dimension, refused when what the file stores of the dataset is too small for that many values.
Shape shape_of(hid_t file, hid_t dataset, hid_t space, Type type, const fs::path& name, const std::string& path) {
  const Handle creation{H5Dget_create_plist(dataset), H5Pclose, "read", name, path};
  if (H5Pget_layout(creation) == H5D_VIRTUAL || H5Pget_external_count(creation) != 0) refuse_foreign(name, path);
  const int rank = H5Sget_simple_extent_ndims(space);
  const int filters = H5Pget_nfilters(creation);
  hsize_t file_bytes = 0;
  if (rank < 0 || filters < 0 || H5Fget_filesize(file, &file_bytes) < 0) fail("read", name, path);
  std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
  if (H5Sget_simple_extent_dims(space, extent.data(), nullptr) < 0) fail("read", name, path);

  const std::uint64_t stored_bytes = std::min<std::uint64_t>(file_bytes, H5Dget_storage_size(dataset));
  std::uint64_t room = stored_bytes * (filters > 0 ? largest_compression : 1) / size_of(type);
  const bool is_empty = std::ranges::count(extent, 0) > 0;
  for (const hsize_t size : extent) {
    if (is_empty) break;
    if (size > room)
      throw core::IoError(fmt::format("cannot read {} in {}: the file is too small for its size of {}; it is damaged",
                                      path, name.string(), fmt::join(extent, " x ")));
    room /= size;
  }
  return {extent.begin(), extent.end()};
}

}  // namespace

hid_t numeric_type(Type type) {
  switch (type) {
    case Type::F64:
      return H5T_IEEE_F64LE;
    case Type::I64:
      return H5T_STD_I64LE;
    case Type::U64:
      return H5T_STD_U64LE;
    case Type::U32:
      return H5T_STD_U32LE;
    case Type::U8:
      return H5T_STD_U8LE;
    case Type::Text:
      break;
  }
  return H5I_INVALID_HID;
}

std::size_t size_of(Type type) {
  switch (type) {
    case Type::U32:
      return 4;
    case Type::U8:
      return 1;
    case Type::Text:
      return text_reference_bytes;
    default:
      return 8;
  }
}

std::uint64_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

Handle make_space(const fs::path& file, const std::string& object, const Shape& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose, "create", file, object};
}

Dataset::Dataset(hid_t file, const fs::path& name, const std::string& path)
    : name_(name),
      path_(path),
      id_(H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "read", name, path),
      space_(H5Dget_space(id_), H5Sclose, "read", name, path),
      type_(type_of_dataset(id_, name, path)),
      shape_(shape_of(file, id_, space_, type_, name, path)) {}

void Dataset::read(Type asked, void* values, std::uint64_t first, std::uint64_t count) const {
  if (type_ != asked)
    throw core::IoError(
        fmt::format("cannot read {} in {}: it has another type than the file format says", path_, name_.string()));
  if (count == 0) return;
  const Handle memory = make_space(name_, path_, {count});
  if (shape_.size() == 1) {
    const hsize_t start = first;
    const hsize_t extent = count;
    if (H5Sselect_hyperslab(space_, H5S_SELECT_SET, &start, nullptr, &extent, nullptr) < 0) fail("read", name_, path_);
  }
  if (H5Dread(id_, numeric_type(asked), memory, space_, H5P_DEFAULT, values) < 0) fail("read", name_, path_);
}

std::vector<std::string> Dataset::read_text() const {
  if (type_ != Type::Text)
    throw core::IoError(fmt::format("cannot read {} in {}: it is not text", path_, name_.string()));
  std::vector<char*> pointers(elements(), nullptr);
  if (pointers.empty()) return {};
  const Handle element = text_type(name_);
  if (H5Dread(id_, element, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) < 0) fail("read", name_, path_);
  std::vector<std::string> values;
  for (const char* pointer : pointers) values.push_back(core::printable(pointer == nullptr ? "" : pointer));
  H5Dvlen_reclaim(element, space_, H5P_DEFAULT, pointers.data());
  return values;
}

}  // namespace ridgeloc::results::hdf5
