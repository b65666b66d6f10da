#include <fmt/format.h>
#include <hdf5_hl.h>

#include "core/error.hpp"
#include "core/printable.hpp"
#include "results/hdf5/hdf5.hpp"
#include "results/hdf5/hdf5_handle.hpp"

namespace ridgeloc::results::hdf5 {
namespace {

namespace fs = std::filesystem;

/// An attribute's place, in the terms of the C API and in words.
struct Place {
  hid_t file;
  const fs::path& path;
  const std::string& object;
  const std::string& name;

  std::string words() const { return fmt::format("the attribute {} of {}", name, object); }
};

void write(const Place& place, hid_t type, const Handle& space, const void* value) {
  const Handle attribute{H5Acreate_by_name(place.file, place.object.c_str(), place.name.c_str(), type, space,
                                           H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
                         H5Aclose, "create", place.path, place.words()};
  const bool has_value = H5Sget_simple_extent_npoints(space) > 0;
  if (has_value && H5Awrite(attribute, type, value) < 0) fail("write", place.path, place.words());
}

Handle scalar_space(const Place& place) {
  return {H5Screate(H5S_SCALAR), H5Sclose, "create", place.path, place.words()};
}

/// HDF5 takes no array of size 0 for an attribute's value: an empty list has a null dataspace.
Handle array_space(const Place& place, hsize_t size) {
  if (size == 0) return {H5Screate(H5S_NULL), H5Sclose, "create", place.path, place.words()};
  return {H5Screate_simple(1, &size, nullptr), H5Sclose, "create", place.path, place.words()};
}

Handle open_attribute(const Place& place) {
  require_own(place.file, place.path, place.object);
  return {H5Aopen_by_name(place.file, place.object.c_str(), place.name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
          "read", place.path, place.words()};
}

/// Number of values of an attribute of the expected class. An attribute lies in its object's header, where
/// HDF5 itself allows no more than 64 KiB.
std::size_t checked_size(const Place& place, const Handle& attribute, H5T_class_t expected) {
  constexpr hssize_t largest = 65536;
  const Handle space{H5Aget_space(attribute), H5Sclose, "read", place.path, place.words()};
  const Handle type{H5Aget_type(attribute), H5Tclose, "read", place.path, place.words()};
  const hssize_t size = H5Sget_simple_extent_npoints(space);
  const bool is_expected = H5Tget_class(type) == expected && (expected != H5T_STRING || H5Tis_variable_str(type) > 0);
  if (!is_expected || size < 0 || size > largest)
    throw core::IoError(
        fmt::format("cannot read {} in {}: it is not as the file format says", place.words(), place.path.string()));
  return static_cast<std::size_t>(size);
}

}  // namespace

void File::write_attribute(const std::string& object, const std::string& name, const std::string& value) {
  const Place place{id_, path_, object, name};
  const char* pointer = value.c_str();
  hdf5::write(place, text_type(path_), scalar_space(place), &pointer);
}

void File::write_attribute(const std::string& object, const std::string& name, const std::vector<std::string>& value) {
  const Place place{id_, path_, object, name};
  std::vector<const char*> pointers;
  for (const std::string& text : value) pointers.push_back(text.c_str());
  hdf5::write(place, text_type(path_), array_space(place, pointers.size()), pointers.data());
}

void File::write_attribute(const std::string& object, const std::string& name, std::uint64_t value) {
  const Place place{id_, path_, object, name};
  hdf5::write(place, H5T_STD_U64LE, scalar_space(place), &value);
}

void File::write_attribute(const std::string& object, const std::string& name,
                           const std::vector<std::uint64_t>& value) {
  const Place place{id_, path_, object, name};
  hdf5::write(place, H5T_STD_U64LE, array_space(place, value.size()), value.data());
}

void File::write_attribute(const std::string& object, const std::string& name, double value) {
  const Place place{id_, path_, object, name};
  hdf5::write(place, H5T_IEEE_F64LE, scalar_space(place), &value);
}

std::vector<std::string> File::attribute_names(const std::string& object) const {
  require_own(id_, path_, object);
  std::vector<std::string> names;
  const auto collect = [](hid_t, const char* name, const H5A_info_t*, void* list) -> herr_t {
    static_cast<std::vector<std::string>*>(list)->emplace_back(name);
    return 0;
  };
  if (H5Aiterate_by_name(id_, object.c_str(), H5_INDEX_NAME, H5_ITER_INC, nullptr, collect, &names, H5P_DEFAULT) < 0)
    fail("read", path_, "the attributes of " + object);
  return names;
}

bool File::has_attribute(const std::string& object, const std::string& name) const {
  require_own(id_, path_, object);
  const htri_t is_there = H5Aexists_by_name(id_, object.c_str(), name.c_str(), H5P_DEFAULT);
  if (is_there < 0) fail("read", path_, Place{id_, path_, object, name}.words());
  return is_there > 0;
}

std::vector<std::string> File::texts_attribute(const std::string& object, const std::string& name) const {
  const Place place{id_, path_, object, name};
  const Handle attribute = open_attribute(place);
  std::vector<char*> pointers(checked_size(place, attribute, H5T_STRING), nullptr);
  if (pointers.empty()) return {};
  const Handle type = text_type(path_);
  if (H5Aread(attribute, type, pointers.data()) < 0) fail("read", path_, place.words());
  std::vector<std::string> values;
  for (const char* pointer : pointers) values.push_back(core::printable(pointer == nullptr ? "" : pointer));
  H5Dvlen_reclaim(type, array_space(place, pointers.size()), H5P_DEFAULT, pointers.data());
  return values;
}

std::vector<std::uint64_t> File::numbers_attribute(const std::string& object, const std::string& name) const {
  const Place place{id_, path_, object, name};
  const Handle attribute = open_attribute(place);
  std::vector<std::uint64_t> values(checked_size(place, attribute, H5T_INTEGER));
  if (!values.empty() && H5Aread(attribute, H5T_STD_U64LE, values.data()) < 0) fail("read", path_, place.words());
  return values;
}

double File::real_attribute(const std::string& object, const std::string& name) const {
  const Place place{id_, path_, object, name};
  const Handle attribute = open_attribute(place);
  double value = 0.0;
  if (checked_size(place, attribute, H5T_FLOAT) != 1 || H5Aread(attribute, H5T_IEEE_F64LE, &value) < 0)
    fail("read", path_, place.words());
  return value;
}

std::string File::text_attribute(const std::string& object, const std::string& name) const {
  const std::vector<std::string> values = texts_attribute(object, name);
  return values.empty() ? std::string() : values.front();
}

std::uint64_t File::number_attribute(const std::string& object, const std::string& name) const {
  const std::vector<std::uint64_t> values = numbers_attribute(object, name);
  return values.empty() ? 0 : values.front();
}

void File::make_scale(const std::string& scale, const std::string& name) {
  const Handle dataset{H5Dopen2(id_, scale.c_str(), H5P_DEFAULT), H5Dclose, "open", path_, scale};
  if (H5DSset_scale(dataset, name.c_str()) < 0) fail("make a dimension scale of", path_, scale);
}

void File::attach_scale(const std::string& dataset, std::uint32_t dimension, const std::string& scale) {
  const Handle values{H5Dopen2(id_, dataset.c_str(), H5P_DEFAULT), H5Dclose, "open", path_, dataset};
  const Handle axis{H5Dopen2(id_, scale.c_str(), H5P_DEFAULT), H5Dclose, "open", path_, scale};
  if (H5DSattach_scale(values, axis, dimension) < 0) fail("attach a dimension scale to", path_, dataset);
}

}  // namespace ridgeloc::results::hdf5
