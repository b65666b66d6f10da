#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <thread>

namespace ridgeloc::results {

/// What a run says of itself, beside the parts that it writes.
struct RunRecord {
  enum class State : std::uint64_t { Computing, Writing, Stopped };  ///< Writing: all is computed, and being sealed
  State state = State::Computing;
  std::uint64_t process = 0;
  std::string machine;
  std::string begun;  ///< UTC, ISO 8601
  double seconds = 0.0;
  std::uint64_t workers = 0;
  std::uint64_t blocks_total = 0;  ///< of this run; with a stop rule as far as is known
  std::uint64_t blocks_done = 0;   ///< those found finished included
  std::uint64_t trials_total = 0;
  std::uint64_t trials_done = 0;   ///< by this run, those of blocks under way included
  std::uint64_t trials_found = 0;  ///< finished before

  bool operator==(const RunRecord&) const = default;
};

/// Where a run says so, in the folder of its parts.
std::filesystem::path run_record_file(const std::filesystem::path& folder);

/// The record in a folder, and how long ago it was written; none if there is none that can be read.
struct FoundRecord {
  RunRecord record;
  double age_s = 0.0;
};
std::optional<FoundRecord> find_run_record(const std::filesystem::path& folder);

/// The record of a run that writes into a folder, told by its going on while it is looked at: none of one that has
/// stopped, or that says nothing new for 5 s. Clocks and dates of files are not asked: those of another machine may be
/// wrong.
std::optional<RunRecord> find_living_run(const std::filesystem::path& folder);

/// Writes a record every two seconds while it lives, and a last one with `State::Stopped`. What goes wrong is let pass:
/// nobody's work depends on it.
class RunRecorder {
 public:
  /// `now` is asked from another thread; process, machine and date are filled in here.
  RunRecorder(std::filesystem::path folder, std::function<RunRecord()> now);

 private:
  std::jthread thread_;
};

}  // namespace ridgeloc::results
