#include "results/hdf5/hdf5.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <functional>
#include <numeric>
#include <ranges>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "results/hdf5/hdf5_handle.hpp"
#include "results/util/digest.hpp"

namespace ridgeloc::results::hdf5 {
namespace {

namespace fs = std::filesystem;

// Values are hashed as they lie in memory and compared with their little-endian form in files.
static_assert(std::endian::native == std::endian::little, "the result store assumes a little-endian machine");

/// Deflate cannot shrink data by more than this factor (zlib's technical notes): an extent that would need more is
/// damage, and is refused before memory is asked for.
constexpr std::uint64_t largest_compression = 1032;
/// Bytes that one variable-length string takes in a dataset: length, address of the heap, index.
constexpr std::uint64_t text_reference_bytes = 16;
/// Values per chunk of compressed datasets: half a megabyte of 64-bit counts, well inside HDF5's chunk cache.
constexpr std::uint64_t chunk_values = 65536;
/// Fewer values are not worth the index of their chunks, which takes some kilobytes.
constexpr std::uint64_t fewest_compressed = 1024;

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

/// Before the first other call of a thread. HDF5 prints its error stack by default, once per thread that has
/// not been told otherwise; and its exit handler crashes over a file that could not be closed because the
/// disk was full.
void prepare() {
  static const herr_t without_exit_handler = H5dont_atexit();
  static_cast<void>(without_exit_handler);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

std::uint64_t product(const Shape& shape) {
  return std::accumulate(shape.begin(), shape.end(), std::uint64_t{1}, std::multiplies<>());
}

Handle make_space(const fs::path& file, const std::string& object, const Shape& shape) {
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return {H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose, "create", file, object};
}

Handle make_creation_properties(const fs::path& file, const std::string& object, const Shape& shape, Layout layout) {
  Handle properties{H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "create", file, object};
  bool good = H5Pset_obj_track_times(properties, false) >= 0 &&
              H5Pset_attr_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) >= 0;
  if (layout == Layout::Compressed && product(shape) >= fewest_compressed) {
    std::vector<hsize_t> chunk(shape.begin(), shape.end());
    std::uint64_t room = chunk_values;
    for (hsize_t& size : chunk | std::views::reverse) {
      size = std::clamp<std::uint64_t>(room, 1, size);
      room /= size;
    }
    good = good && H5Pset_chunk(properties, static_cast<int>(chunk.size()), chunk.data()) >= 0 &&
           H5Pset_shuffle(properties) >= 0 && H5Pset_deflate(properties, 1) >= 0;
  }
  if (!good) fail("create", file, object);
  return properties;
}

/// Opens a dataset to read it. Throws core::InputError if its values lie in another file.
Handle open_dataset(hid_t file, const fs::path& name, const std::string& path) {
  require_own(file, name, path);
  Handle dataset{H5Dopen2(file, path.c_str(), H5P_DEFAULT), H5Dclose, "read", name, path};
  const Handle creation{H5Dget_create_plist(dataset), H5Pclose, "read", name, path};
  if (H5Pget_layout(creation) == H5D_VIRTUAL || H5Pget_external_count(creation) != 0) refuse_foreign(name, path);
  return dataset;
}

/// Whether another program has locked a file, as HDF5 does while it writes.
bool is_locked(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
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

}  // namespace

File File::create(const fs::path& path) {
  prepare();
  const Handle creation{H5Pcreate(H5P_FILE_CREATE), H5Pclose, "create", path, "the file"};
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "create", path, "the file"};
  // Locks fail on some network file systems; here files are private until published and never change
  // afterwards.
  if (H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) < 0 ||
      H5Pset_attr_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) < 0 ||
      H5Pset_file_locking(access, false, true) < 0)
    fail("create", path, "the file");
  const hid_t id = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, creation, access);
  if (id < 0) fail("create", path, "the file");
  return {path, id};
}

File File::open(const fs::path& path) {
  prepare();
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "open", path, "the file"};
  if (H5Pset_file_locking(access, false, true) < 0) fail("open", path, "the file");
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  if (id < 0 && is_locked(path))
    throw core::InputError(fmt::format(
        "{} is locked by another program, which may be writing to it; close it there and try again", path.string()));
  if (id < 0) fail("open", path, "the file");
  return {path, id};
}

File::File(File&& other) noexcept
    : path_(std::move(other.path_)), id_(std::exchange(other.id_, -1)), manifest_(std::move(other.manifest_)) {}

File::~File() {
  if (id_ >= 0) H5Fclose(id_);
}

void File::close() {
  if (H5Fflush(id_, H5F_SCOPE_GLOBAL) < 0) fail("write", path_, "the file");
  if (H5Fclose(std::exchange(id_, -1)) < 0) fail("write", path_, "the file");
}

void File::create_group(const std::string& path) {
  const Handle properties{H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "create", path_, path};
  if (H5Pset_obj_track_times(properties, false) < 0 ||
      H5Pset_link_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) < 0 ||
      H5Pset_attr_creation_order(properties, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED) < 0)
    fail("create", path_, path);
  const Handle group{H5Gcreate2(id_, path.c_str(), H5P_DEFAULT, properties, H5P_DEFAULT), H5Gclose, "create", path_,
                     path};
}

bool File::contains(const std::string& path) const {
  // H5Lexists answers for the last link of a path alone: every link before it must exist.
  for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
    const htri_t is_there = H5Lexists(id_, path.substr(0, end).c_str(), H5P_DEFAULT);
    if (is_there < 0) fail("read", path_, path);
    if (is_there == 0) return false;
    require_own_link(id_, path_, path.substr(0, end));
    if (end == std::string::npos) return true;
  }
}

void File::write_values(const std::string& path, Type type, const void* values, const Shape& shape, Layout layout) {
  const Handle space = make_space(path_, path, shape);
  const Handle properties = make_creation_properties(path_, path, shape, layout);
  const hid_t element = numeric_type(type);
  Handle dataset{H5Dcreate2(id_, path.c_str(), element, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
                 "create", path_, path};
  const std::uint64_t count = product(shape);
  if (count > 0 && H5Dwrite(dataset, element, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail("write", path_, path);
  dataset.close("write", path_, path);
  record(path, type, shape, sha256_hex(std::span(static_cast<const std::byte*>(values), count * size_of(type))));
}

void File::write(const std::string& path, const std::vector<std::string>& values) {
  const Handle space = make_space(path_, path, {values.size()});
  const Handle properties = make_creation_properties(path_, path, {values.size()}, Layout::Contiguous);
  const Handle element = text_type(path_);
  Handle dataset{H5Dcreate2(id_, path.c_str(), element, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose,
                 "create", path_, path};
  std::vector<const char*> pointers;
  for (const std::string& value : values) pointers.push_back(value.c_str());
  if (!values.empty() && H5Dwrite(dataset, element, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) < 0)
    fail("write", path_, path);
  dataset.close("write", path_, path);
  record(path, Type::Text, {values.size()}, digest_of(values));
}

Type File::type(const std::string& path) const {
  const Handle dataset = open_dataset(id_, path_, path);
  const Handle element{H5Dget_type(dataset), H5Tclose, "read", path_, path};
  if (H5Tget_class(element) == H5T_STRING && H5Tis_variable_str(element) > 0) return Type::Text;
  for (const Type type : {Type::F64, Type::I64, Type::U64, Type::U32, Type::U8})
    if (H5Tequal(element, numeric_type(type)) > 0) return type;
  throw core::IoError(fmt::format("cannot read {} in {}: its type is not of the file format", path, path_.string()));
}

Shape File::shape(const std::string& path) const {
  const Handle dataset = open_dataset(id_, path_, path);
  const Handle space{H5Dget_space(dataset), H5Sclose, "read", path_, path};
  const int rank = H5Sget_simple_extent_ndims(space);
  const Handle creation{H5Dget_create_plist(dataset), H5Pclose, "read", path_, path};
  const int filters = H5Pget_nfilters(creation);
  hsize_t file_bytes = 0;
  if (rank < 0 || filters < 0 || H5Fget_filesize(id_, &file_bytes) < 0) fail("read", path_, path);
  std::vector<hsize_t> extent(static_cast<std::size_t>(rank));
  if (H5Sget_simple_extent_dims(space, extent.data(), nullptr) < 0) fail("read", path_, path);

  const std::uint64_t stored_bytes = std::min<std::uint64_t>(file_bytes, H5Dget_storage_size(dataset));
  std::uint64_t room = stored_bytes * (filters > 0 ? largest_compression : 1) / size_of(type(path));
  const bool is_empty = std::ranges::count(extent, 0) > 0;
  for (const hsize_t size : extent) {
    if (is_empty) break;
    if (size > room)
      throw core::IoError(fmt::format("cannot read {} in {}: the file is too small for its size of {}; it is damaged",
                                      path, path_.string(), fmt::join(extent, " x ")));
    room /= size;
  }
  return {extent.begin(), extent.end()};
}

std::uint64_t File::elements(const std::string& path) const {
  return product(shape(path));
}

void File::require_range(const std::string& path, std::uint64_t first, std::uint64_t count) const {
  const Shape extent = shape(path);
  if (extent.size() != 1 || first > extent[0] || count > extent[0] - first)
    throw core::IoError(fmt::format("cannot read {} in {}: values {} to {} are not there; the file is damaged", path,
                                    path_.string(), first, first + count));
}

void File::read_values(const std::string& path, Type asked, void* values, std::uint64_t first,
                       std::uint64_t count) const {
  if (type(path) != asked)
    throw core::IoError(
        fmt::format("cannot read {} in {}: it has another type than the file format says", path, path_.string()));
  if (count == 0) return;
  const Handle dataset = open_dataset(id_, path_, path);
  const Handle space{H5Dget_space(dataset), H5Sclose, "read", path_, path};
  const Handle memory = make_space(path_, path, {count});
  if (H5Sget_simple_extent_ndims(space) == 1) {
    const hsize_t start = first;
    const hsize_t extent = count;
    if (H5Sselect_hyperslab(space, H5S_SELECT_SET, &start, nullptr, &extent, nullptr) < 0) fail("read", path_, path);
  }
  if (H5Dread(dataset, numeric_type(asked), memory, space, H5P_DEFAULT, values) < 0) fail("read", path_, path);
}

std::vector<std::string> File::read_text(const std::string& path) const {
  if (type(path) != Type::Text)
    throw core::IoError(fmt::format("cannot read {} in {}: it is not text", path, path_.string()));
  std::vector<char*> pointers(elements(path), nullptr);
  if (pointers.empty()) return {};
  const Handle dataset = open_dataset(id_, path_, path);
  const Handle space{H5Dget_space(dataset), H5Sclose, "read", path_, path};
  const Handle element = text_type(path_);
  if (H5Dread(dataset, element, H5S_ALL, H5S_ALL, H5P_DEFAULT, pointers.data()) < 0) fail("read", path_, path);
  std::vector<std::string> values;
  for (const char* pointer : pointers) values.emplace_back(pointer == nullptr ? "" : pointer);
  H5Dvlen_reclaim(element, space, H5P_DEFAULT, pointers.data());
  return values;
}

std::string library_version() {
  prepare();
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

bool is_hdf5(const fs::path& path) {
  prepare();
  return H5Fis_hdf5(path.c_str()) > 0;
}

}  // namespace ridgeloc::results::hdf5
