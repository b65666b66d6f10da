#include "results/util/file_system.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <fstream>
#include <random>
#include <string_view>
#include <system_error>
#include <utility>

#include "core/error.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

constexpr const char* temporary_suffix = ".ridgeloc-tmp";

fs::path folder_of(const fs::path& file) {
  const fs::path parent = file.parent_path();
  return parent.empty() ? fs::path(".") : parent;
}

/// Whether fsync says that it cannot do such a thing at all here, rather than that it failed: many network and
/// encrypting file systems cannot synchronize a folder, and say so in several ways. The rename itself has succeeded
/// then.
bool is_unsupported(int error) {
  return error == EINVAL || error == ENOTSUP || error == EOPNOTSUPP || error == EBADF || error == ENOSYS;
}

/// Flushes a file or a folder to the disk, where the file system can.
void synchronize(const fs::path& path) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) throw core::IoError(fmt::format("cannot open {}: {}", path.string(), system_message(errno)));
  const int returned = ::fsync(descriptor);
  const int error = errno;
  ::close(descriptor);
  if (returned != 0 && !is_unsupported(error))
    throw core::IoError(fmt::format("cannot flush {} to the disk: {}", path.string(), system_message(error)));
}

/// Creates a file beside another one that nobody else has, not even through a link. Empty, with errno set, where that
/// cannot be.
fs::path create_alone(const fs::path& beside) {
  constexpr mode_t as_the_user_allows = 0666;
  for (;;) {
    fs::path path = fmt::format("{}.{}{}", beside.string(), random_part(), temporary_suffix);
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, as_the_user_allows);
    if (descriptor >= 0) ::close(descriptor);
    if (descriptor >= 0) return path;
    if (errno != EEXIST) return {};
  }
}

}  // namespace

std::string system_message(int error) {
  return std::generic_category().message(error);
}

std::string random_part() {
  std::random_device device;
  return fmt::format("{:08x}{:08x}", device(), device());
}

bool path_exists(const fs::path& path) {
  std::error_code unknown;
  return fs::exists(path, unknown);
}

void require_writable(const fs::path& file) {
  const fs::path folder = folder_of(file);
  std::error_code error;
  if (file.filename().empty() || fs::is_directory(file, error))
    throw core::InputError(fmt::format("cannot write {}: it is a folder; add a file name to -o", file.string()));
  if (!fs::exists(folder, error))
    throw core::InputError(fmt::format("cannot write {}: the folder {} does not exist; create it or choose another -o",
                                       file.string(), folder.string()));
  if (!fs::is_directory(folder, error))
    throw core::InputError(
        fmt::format("cannot write {}: {} is not a folder; choose another -o", file.string(), folder.string()));

  // Only an attempt tells the truth about permissions, read-only mounts and quotas.
  // Its name is that of a temporary: what a killed program leaves of it is removed like one.
  const fs::path probe = create_alone(file);
  if (probe.empty())
    throw core::InputError(fmt::format("cannot write {}: {}; make the folder {} writable or choose another -o",
                                       file.string(), system_message(errno), folder.string()));
  ::unlink(probe.c_str());
}

void require_new(const fs::path& file) {
  require_writable(file);
  std::error_code unknown;
  if (fs::exists(file, unknown))
    throw core::InputError(fmt::format("{} exists; choose another -o or remove it", file.string()));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directory(folder, error);
  if (error)
    throw core::InputError(
        fmt::format("cannot create the folder {}: {}; choose another -o", folder.string(), error.message()));
  synchronize(folder_of(folder));
}

TemporaryFile::TemporaryFile(fs::path final_path) : final_(std::move(final_path)), temporary_(create_alone(final_)) {
  if (temporary_.empty())
    throw core::IoError(fmt::format("cannot write {}: {}", final_.string(), system_message(errno)));
}

TemporaryFile::~TemporaryFile() {
  if (published_) return;
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

void TemporaryFile::publish(Durability durability) {
  if (durability == Durability::Kept) synchronize(temporary_);
  std::error_code error;
  fs::rename(temporary_, final_, error);
  if (error)
    throw core::IoError(
        fmt::format("cannot rename {} to {}: {}", temporary_.string(), final_.string(), error.message()));
  published_ = true;
  if (durability == Durability::Kept) synchronize(folder_of(final_));
}

bool TemporaryFile::is_temporary(const fs::path& file) {
  return file.extension() == temporary_suffix;
}

void TemporaryFile::remove_leftovers(const fs::path& final_path) {
  std::error_code ignored;
  const std::string beginning = final_path.filename().string() + ".";
  for (const fs::directory_entry& entry : fs::directory_iterator(folder_of(final_path), ignored)) {
    if (!is_temporary(entry.path())) continue;
    // What stands between the name and the ending has no dot: "r.h5.csv.<random part>" is another file's.
    const std::string name = entry.path().stem().string();
    const bool of_this_file = name.starts_with(beginning) && name.find('.', beginning.size()) == std::string::npos;
    if (of_this_file) fs::remove(entry.path(), ignored);
  }
}

bool is_plain_file_name(std::string_view name) {
  constexpr std::size_t longest = 200;  // of the 255 bytes that file systems allow
  return !name.empty() && name.size() <= longest && name.front() != '.' &&
         std::ranges::none_of(name, [](unsigned char c) { return c < 0x20 || c == 0x7f || c == '/' || c == '\\'; });
}

bool begins_as_hdf5(const fs::path& file) {
  constexpr std::string_view signature = "\x89HDF\r\n\x1a\n";
  std::array<char, signature.size()> beginning{};
  // What is read from a pipe is gone.
  std::error_code missing;
  if (!fs::is_regular_file(file, missing)) return false;
  std::ifstream in(file, std::ios::binary);
  in.read(beginning.data(), beginning.size());
  return in && std::string_view(beginning.data(), beginning.size()) == signature;
}

void refuse_to_replace_result(const fs::path& file) {
  if (begins_as_hdf5(file))
    throw core::InputError(
        fmt::format("{} is an HDF5 file and is not replaced; choose another -o or remove it", file.string()));
}

std::string temporary_name() {
  std::error_code missing;
  const fs::path folder = fs::temp_directory_path(missing);
  if (missing) throw core::IoError("there is no folder for temporary files; set TMPDIR to a writable one");
  return (folder / "ridgeloc-XXXXXX").string();
}

TemporaryFolder::TemporaryFolder() {
  std::string name = temporary_name();
  if (::mkdtemp(name.data()) == nullptr)
    throw core::IoError(fmt::format("cannot create a temporary folder {}: {}; set TMPDIR to a writable one", name,
                                    system_message(errno)));
  path_ = name;
}

TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

}  // namespace ridgeloc::results
