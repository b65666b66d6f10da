#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ridgeloc::results {

/// Where, when and by what a result was computed. Nothing in here takes part in the digest of a result.
struct Provenance {
  // What the program knows about its own build.
  std::string program_version;
  std::string git_commit;
  bool git_dirty = false;  ///< whether the working tree had changes that no commit holds
  std::string compiler;
  std::string flags;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name and version
  // What the runner knows about the run.
  unsigned threads = 0;
  std::vector<std::pair<std::string, double>> wall_time_s;  ///< phase and its seconds
  // What the machine says: see `complete`.
  std::string processor;
  std::string date;  ///< when the result was sealed, UTC, ISO 8601
  // What else the blocks come from: a line for each sealed result that this one goes on from or is merged from.
  std::vector<std::string> contributions;
};

/// What a sealed result says of itself; libraries and phases by name. Throws core::InputError if it cannot be read.
Provenance read_provenance(const std::filesystem::path& result);

/// The contributions of a sealed result, and a line for itself: which program computed it, where and when. Throws
/// core::InputError if it cannot be read.
std::vector<std::string> contributions_of(const std::filesystem::path& result);

/// Adds the processor's model, the date and the version of HDF5.
void complete(Provenance& provenance);

/// Model of the first processor by /proc/cpuinfo; "unknown" where there is none.
std::string processor_model();

}  // namespace ridgeloc::results
