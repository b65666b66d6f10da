#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace ridgeloc::results {

/// Whether a file or folder of that name is there; a name that cannot be asked for counts as absent.
bool path_exists(const std::filesystem::path& path);

/// Checks that a file of this name can be written, and leaves nothing behind.
/// Throws core::InputError that says why not and what to do.
void require_writable(const std::filesystem::path& file);

/// The same, and that there is no such file yet.
void require_new(const std::filesystem::path& file);

/// Makes a folder, unless it is there, and its name durable: what files in it are worth depends on that.
/// Throws core::InputError.
void make_folder(const std::filesystem::path& folder);

/// Whether a text that nobody has checked is safe as the name of a file in a folder: neither empty nor hidden, without
/// a separator or control characters, with room for an ending.
bool is_plain_file_name(std::string_view name);

/// Whether a file begins as HDF5 files do; false for a missing one, and for pipes and devices, which stay unread.
bool begins_as_hdf5(const std::filesystem::path& file);

/// Throws core::InputError if a file of this name is HDF5: a result is hours of work, and a table or a picture is not
/// to replace it.
void refuse_to_replace_result(const std::filesystem::path& file);

/// A file that appears under its name complete or not at all. Write to `path()`, close and check it, then
/// `publish()`. Until then the destructor removes it.
class TemporaryFile {
 public:
  /// Creates the temporary beside `final_path`, so that the rename stays within one file system; no other process has
  /// it. Throws core::IoError.
  explicit TemporaryFile(std::filesystem::path final_path);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  const std::filesystem::path& path() const { return temporary_; }

  /// Makes the content durable, gives it its name (replacing an older file) and makes the name durable; a file system
  /// that cannot do so at all is let pass. With `Durability::Waived` a power cut may take what was written.
  /// Throws core::IoError.
  enum class Durability { Kept, Waived };
  void publish(Durability durability = Durability::Kept);

  /// Whether a file in a folder is such a temporary, left by a killed program.
  static bool is_temporary(const std::filesystem::path& file);

  /// Removes temporaries of that file that killed programs have left beside it. Only for who may write the file.
  static void remove_leftovers(const std::filesystem::path& final_path);

 private:
  std::filesystem::path final_;
  std::filesystem::path temporary_;
  bool published_ = false;
};

/// A name in the folder for temporary files that mkstemp and mkdtemp complete. Throws core::IoError where there is no
/// such folder.
std::string temporary_name();

/// A folder for temporary files that goes with its object. Throws core::IoError where none can be made.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What the system says of an error number.
std::string system_message(int error);

/// Digits that two processes, also on two machines or in two containers, as good as never draw alike.
std::string random_part();

}  // namespace ridgeloc::results
