#pragma once
// Internal to the HDF5 layer: a dataset that is read.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "results/hdf5/hdf5.hpp"
#include "results/hdf5/hdf5_handle.hpp"

namespace ridgeloc::results::hdf5 {

/// Values per chunk of compressed datasets: half a megabyte of 64-bit counts, well inside HDF5's chunk cache.
inline constexpr std::uint64_t chunk_values = 65536;

/// The type of numbers in a file. Precondition: not Text.
hid_t numeric_type(Type type);
/// Bytes of a value; of a text those of its reference.
std::size_t size_of(Type type);
std::uint64_t product(const Shape& shape);
Handle make_space(const std::filesystem::path& file, const std::string& object, const Shape& shape);

/// An open dataset whose extent its stored bytes can fill. Opening is what takes time where datasets are small, so all
/// that is asked about one is asked of one object.
class Dataset {
 public:
  /// Throws core::IoError if there is none, or its extent or type is not of the format, core::InputError if its values
  /// lie in another file. Precondition: no link on the path leads to another file.
  Dataset(hid_t file, const std::filesystem::path& name, const std::string& path);

  Type type() const { return type_; }
  const Shape& shape() const { return shape_; }
  std::uint64_t elements() const { return product(shape_); }

  /// `count` values from index `first` on, of a dataset with one dimension; all values of any other. Throws
  /// core::IoError if it has another type.
  void read(Type type, void* values, std::uint64_t first, std::uint64_t count) const;
  std::vector<std::string> read_text() const;

 private:
  const std::filesystem::path& name_;
  const std::string& path_;
  Handle id_;
  Handle space_;
  Type type_;
  Shape shape_;
};

}  // namespace ridgeloc::results::hdf5
