#include "results/store/run_record.hpp"

#include <fmt/chrono.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <condition_variable>
#include <ctime>
#include <fstream>
#include <mutex>
#include <sstream>
#include <system_error>
#include <utility>

#include "core/printable.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {
namespace {

namespace fs = std::filesystem;

constexpr std::chrono::seconds interval{2};
/// Who says nothing new for so long is taken for gone.
constexpr auto patience = 5 * interval / 2;

/// A line of the file for each: its name, a blank, its value.
constexpr std::pair<const char*, std::uint64_t RunRecord::*> counts[] = {
    {"process", &RunRecord::process},           {"workers", &RunRecord::workers},
    {"blocks_total", &RunRecord::blocks_total}, {"blocks_done", &RunRecord::blocks_done},
    {"trials_total", &RunRecord::trials_total}, {"trials_done", &RunRecord::trials_done},
    {"trials_found", &RunRecord::trials_found}};

std::string text_of(const RunRecord& record) {
  std::string text =
      fmt::format("state {}\nmachine {}\nbegun {}\nseconds {}\n", static_cast<std::uint64_t>(record.state),
                  record.machine, record.begun, record.seconds);
  for (const auto& [name, member] : counts) text += fmt::format("{} {}\n", name, record.*member);
  return text;
}

/// Whether a line is of a record and could be read.
bool read_line(const std::string& line, RunRecord& record) {
  std::istringstream in(line);
  std::string name;
  in >> name;
  if (name == "machine") in >> record.machine;
  if (name == "begun") in >> record.begun;
  record.machine = core::printable(std::move(record.machine));
  record.begun = core::printable(std::move(record.begun));
  if (name == "seconds") in >> record.seconds;
  if (name == "state") {
    std::uint64_t state = 0;
    in >> state;
    if (state > static_cast<std::uint64_t>(RunRecord::State::Stopped)) return false;
    record.state = static_cast<RunRecord::State>(state);
  }
  for (const auto& [known, member] : counts)
    if (name == known) in >> record.*member;
  return !in.fail();
}

std::string machine_name() {
  std::array<char, 256> name{};
  if (::gethostname(name.data(), name.size() - 1) != 0 || name[0] == '\0') return "unknown";
  return name.data();
}

void write(const fs::path& file, const RunRecord& record) {
  try {
    TemporaryFile temporary(file);
    std::ofstream out(temporary.path(), std::ios::binary);
    out << text_of(record);
    out.close();
    if (out) temporary.publish(TemporaryFile::Durability::Waived);
  } catch (const std::exception&) {
    // The disk may be full, or the folder gone: the writer of the parts finds out, and says so.
  }
}

/// The record in a file; none if there is none that can be read.
std::optional<RunRecord> record_in(const fs::path& file) {
  std::error_code absent;
  if (!fs::is_regular_file(file, absent)) return std::nullopt;
  RunRecord record;
  std::ifstream in(file, std::ios::binary);
  std::size_t lines = 0;
  for (std::string line; std::getline(in, line); ++lines)
    if (!read_line(line, record)) return std::nullopt;
  return lines > 0 ? std::optional(record) : std::nullopt;
}

}  // namespace

fs::path run_record_file(const fs::path& folder) {
  return folder / "run.txt";
}

std::optional<FoundRecord> find_run_record(const fs::path& folder) {
  const fs::path file = run_record_file(folder);
  std::optional<RunRecord> record = record_in(file);
  std::error_code absent;
  const fs::file_time_type written = fs::last_write_time(file, absent);
  if (!record || absent) return std::nullopt;
  const std::chrono::duration<double> age = fs::file_time_type::clock::now() - written;
  return FoundRecord{std::move(*record), std::max(age.count(), 0.0)};
}

std::optional<RunRecord> find_living_run(const fs::path& folder) {
  constexpr auto pause = std::chrono::milliseconds(50);
  const fs::path file = run_record_file(folder);
  const std::optional<RunRecord> first = record_in(file);
  if (!first) return std::nullopt;
  const auto deadline = std::chrono::steady_clock::now() + patience;
  for (std::optional<RunRecord> last = first;; last = record_in(file)) {
    if (last && last->state == RunRecord::State::Stopped) return std::nullopt;
    if (last && *last != *first) return last;
    if (std::chrono::steady_clock::now() >= deadline) return std::nullopt;
    std::this_thread::sleep_for(pause);
  }
}

RunRecorder::RunRecorder(fs::path folder, std::function<RunRecord()> now)
    : thread_([file = run_record_file(folder), now = std::move(now)](const std::stop_token& over) {
        const std::string machine = machine_name();
        const std::string begun = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
        const auto filled = [&] {
          RunRecord record = now();
          record.process = static_cast<std::uint64_t>(::getpid());
          record.machine = machine;
          record.begun = begun;
          return record;
        };
        std::mutex mutex;
        std::condition_variable_any wake;
        std::unique_lock lock(mutex);
        do write(file, filled());
        while (!wake.wait_for(lock, over, interval, [&] { return over.stop_requested(); }));
        RunRecord last = filled();
        last.state = RunRecord::State::Stopped;
        write(file, last);
      }) {}

}  // namespace ridgeloc::results
