#include "results/hdf5/hdf5.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <ranges>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "results/hdf5/hdf5_dataset.hpp"
#include "results/hdf5/hdf5_handle.hpp"
#include "results/util/digest.hpp"

namespace ridgeloc::results::hdf5 {
namespace {

namespace fs = std::filesystem;

// Values are hashed as they lie in memory and compared with their little-endian form in files.
static_assert(std::endian::native == std::endian::little, "the result store assumes a little-endian machine");

/// Fewer values are not worth the index of their chunks, which takes some kilobytes.
constexpr std::uint64_t fewest_compressed = 1024;
/// Groups with more members get a heap and two indices, which take longer than all else that there is of a few members.
constexpr unsigned most_compact_links = 64;

/// Before the first other call of a thread. HDF5 prints its error stack by default, once per thread that has
/// not been told otherwise; and its exit handler crashes over a file that could not be closed because the
/// disk was full. A file may name filters, for which HDF5 would load libraries: results have none but deflate.
void prepare() {
  static const herr_t without_exit_handler = H5dont_atexit();
  static const herr_t without_plugins = H5PLset_loading_state(0);
  static_cast<void>(without_exit_handler);
  static_cast<void>(without_plugins);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
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

/// Whether another program has locked a file, as HDF5 does while it writes.
bool is_locked(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return false;
  const bool locked = ::flock(descriptor, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
  ::close(descriptor);
  return locked;
}

}  // namespace

File File::create(const fs::path& path, Hash hash) {
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
  return {path, id, hash};
}

File File::open(const fs::path& path, Hash hash) {
  prepare();
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "open", path, "the file"};
  if (H5Pset_file_locking(access, false, true) < 0) fail("open", path, "the file");
  const hid_t id = H5Fopen(path.c_str(), H5F_ACC_RDONLY, access);
  if (id < 0 && is_locked(path))
    throw core::InputError(fmt::format(
        "{} is locked by another program, which may be writing to it; close it there and try again", path.string()));
  if (id < 0) fail("open", path, "the file");
  return {path, id, hash};
}

File::File(File&& other) noexcept
    : path_(std::move(other.path_)),
      id_(std::exchange(other.id_, -1)),
      hash_(other.hash_),
      manifest_(std::move(other.manifest_)) {}

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
      H5Pset_link_phase_change(properties, most_compact_links, most_compact_links / 2) < 0 ||
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
  record(path, type, shape, digest_of(std::span(static_cast<const std::byte*>(values), count * size_of(type)), hash_));
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
  record(path, Type::Text, {values.size()}, digest_of(values, hash_));
}

Type File::type(const std::string& path) const {
  require_own_path(path);
  return Dataset(id_, path_, path).type();
}

Shape File::shape(const std::string& path) const {
  require_own_path(path);
  return Dataset(id_, path_, path).shape();
}

void File::read_all(const std::string& path, Type type, const MakeRoom& room) const {
  require_own_path(path);
  const Dataset dataset(id_, path_, path);
  dataset.read(type, room(dataset.elements()), 0, dataset.elements());
}

void File::read_range(const std::string& path, Type type, std::uint64_t first, std::uint64_t count,
                      const MakeRoom& room) const {
  require_own_path(path);
  const Dataset dataset(id_, path_, path);
  const Shape& extent = dataset.shape();
  if (extent.size() != 1 || first > extent[0] || count > extent[0] - first)
    throw core::IoError(fmt::format("cannot read {} in {}: values {} to {} are not there; the file is damaged", path,
                                    path_.string(), first, first + count));
  dataset.read(type, room(count), first, count);
}

std::vector<std::string> File::read_text(const std::string& path) const {
  require_own_path(path);
  return Dataset(id_, path_, path).read_text();
}

void File::require_own_path(const std::string& path) const {
  const std::string group = path.substr(0, path.rfind('/'));
  if (!group.empty() && group != own_group_) {
    require_own(id_, path_, group);
    own_group_ = group;
  }
  if (H5Lexists(id_, path.c_str(), H5P_DEFAULT) > 0) require_own_link(id_, path_, path);
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
