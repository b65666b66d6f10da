#pragma once
// Internal to results: the part of HDF5 that result and part files need, with owned handles and one-line
// errors.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

namespace ridgeloc::results::hdf5 {

using Shape = std::vector<std::uint64_t>;

/// Element types of datasets, little-endian in the file.
enum class Type { F64, I64, U64, U32, U8, Text };

template <typename T>
constexpr Type type_of() = delete;
template <>
constexpr Type type_of<double>() {
  return Type::F64;
}
template <>
constexpr Type type_of<std::int64_t>() {
  return Type::I64;
}
template <>
constexpr Type type_of<std::uint64_t>() {
  return Type::U64;
}
template <>
constexpr Type type_of<std::uint32_t>() {
  return Type::U32;
}
template <>
constexpr Type type_of<std::uint8_t>() {
  return Type::U8;
}

/// How the values of datasets are hashed: SHA-256, or XXH3 with 64 bits, a tenth of the time, against accidents alone.
enum class Hash { Sha256, Xxh3 };

/// `Compressed`: chunks with shuffle and gzip level 1, unless the dataset is small; noise in doubles does not compress.
enum class Layout { Contiguous, Compressed };

/// An HDF5 file. Objects are named by their full path, such as "/ledger/mean". Every failure throws
/// core::IoError that names the file and the object. The creation order of links and attributes is kept and
/// no times are stored.
///
/// One thread at a time per object; different files may be used from different threads (the library is
/// thread-safe).
class File {
 public:
  /// A new file, in place of any older one.
  static File create(const std::filesystem::path& path, Hash hash = Hash::Sha256);
  static File open(const std::filesystem::path& path, Hash hash = Hash::Sha256);

  File(File&& other) noexcept;
  File& operator=(File&&) = delete;
  ~File();
  /// Writes everything out. A created file is only good if this returns.
  void close();

  const std::filesystem::path& path() const { return path_; }

  void create_group(const std::string& path);
  /// Throws core::IoError if the file is too damaged to tell.
  bool contains(const std::string& path) const;

  /// Writes a dataset; without a shape it has one dimension. Precondition: the product of `shape` is
  /// values.size().
  template <typename T>
  void write(const std::string& path, const std::vector<T>& values, Shape shape = {},
             Layout layout = Layout::Contiguous) {
    if (shape.empty()) shape = {values.size()};
    write_values(path, type_of<T>(), values.data(), shape, layout);
  }
  void write(const std::string& path, const std::vector<std::string>& values);

  /// Size per dimension, refused when what the file stores of the dataset is too small for that many values.
  Shape shape(const std::string& path) const;
  Type type(const std::string& path) const;

  /// All values of a dataset, the last dimension running fastest.
  template <typename T>
  std::vector<T> read(const std::string& path) const {
    std::vector<T> values;
    read_all(path, type_of<T>(), room_in(values));
    return values;
  }
  /// `count` values of a dataset of one dimension, from index `first` on.
  template <typename T>
  std::vector<T> read(const std::string& path, std::uint64_t first, std::uint64_t count) const {
    std::vector<T> values;
    read_range(path, type_of<T>(), first, count, room_in(values));
    return values;
  }
  /// Texts, here and in attributes, come as core::printable has them: none is a command for a terminal.
  std::vector<std::string> read_text(const std::string& path) const;

  void write_attribute(const std::string& object, const std::string& name, const std::string& value);
  void write_attribute(const std::string& object, const std::string& name, const std::vector<std::string>& value);
  void write_attribute(const std::string& object, const std::string& name, std::uint64_t value);
  void write_attribute(const std::string& object, const std::string& name, const std::vector<std::uint64_t>& value);
  void write_attribute(const std::string& object, const std::string& name, double value);
  /// Sorted.
  std::vector<std::string> attribute_names(const std::string& object) const;
  bool has_attribute(const std::string& object, const std::string& name) const;
  std::string text_attribute(const std::string& object, const std::string& name) const;
  std::vector<std::string> texts_attribute(const std::string& object, const std::string& name) const;
  std::uint64_t number_attribute(const std::string& object, const std::string& name) const;
  double real_attribute(const std::string& object, const std::string& name) const;
  std::vector<std::uint64_t> numbers_attribute(const std::string& object, const std::string& name) const;

  /// Makes a dataset a dimension scale (an axis with values) and attaches it to a dimension of another
  /// dataset.
  void make_scale(const std::string& scale, const std::string& name);
  void attach_scale(const std::string& dataset, std::uint32_t dimension, const std::string& scale);

  /// Digest of all datasets but those under /provenance, as docs/file-format.md defines it for SHA-256: of the values
  /// handed to `write`, and of the values in the file. That both agree is what "verified" means.
  /// With `Extent::Totals` those under /trials are left out too: what is fast to check on each reading.
  enum class Extent { All, Totals };
  std::string written_digest(Extent extent = Extent::All) const;
  std::string content_digest(Extent extent = Extent::All) const;

  /// The same over all attributes in the file that `write_attribute` makes, but those of the root whose names end in
  /// "_sha256", and those below /trials.
  std::string attributes_digest() const;

 private:
  File(std::filesystem::path path, std::int64_t id, Hash hash) : path_(std::move(path)), id_(id), hash_(hash) {}

  /// Makes room for that many values and says where.
  using MakeRoom = std::function<void*(std::uint64_t)>;
  template <typename T>
  static MakeRoom room_in(std::vector<T>& values) {
    return [&values](std::uint64_t count) {
      values.resize(count);
      return static_cast<void*>(values.data());
    };
  }

  void read_all(const std::string& path, Type type, const MakeRoom& room) const;
  void read_range(const std::string& path, Type type, std::uint64_t first, std::uint64_t count,
                  const MakeRoom& room) const;
  /// Throws core::InputError if a link of the path leads to another file; a path that ends early is let pass.
  void require_own_path(const std::string& path) const;
  void write_values(const std::string& path, Type type, const void* values, const Shape& shape, Layout layout);
  void record(const std::string& path, Type type, const Shape& shape, const std::string& digest);
  /// Line of the digest's text; empty for an attribute of another type than `write_attribute` makes.
  std::string attribute_line(const std::string& object, const std::string& name) const;

  std::filesystem::path path_;
  std::int64_t id_ = -1;
  Hash hash_;
  mutable std::string own_group_;                ///< the last one whose path was found to lie in this file
  std::map<std::string, std::string> manifest_;  ///< of the datasets written: path -> line of the digest's text
};

/// Version of the HDF5 library in use, as "1.10.8".
std::string library_version();

/// Whether a file starts like an HDF5 file; false for a missing one.
bool is_hdf5(const std::filesystem::path& path);

}  // namespace ridgeloc::results::hdf5
