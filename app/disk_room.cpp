#include "app/disk_room.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <system_error>

#include "app/output.hpp"
#include "core/error.hpp"
#include "results/store/parts_folder.hpp"
#include "studies/run/pilot.hpp"

namespace ridgeloc::app {

namespace {

namespace fs = std::filesystem;

/// What the totals of one method in one cell take, about: 10 to 20 thousand bytes, by the spread of its histograms.
constexpr double bytes_of_totals = 20e3;

fs::path folder_of(const fs::path& file) {
  return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// Bytes of the values of one trial, over all methods, by having one computed.
double bytes_of_trial(const studies::Study& study, const studies::Plan& plan) {
  const studies::Pilot pilot = studies::run_pilot(study, plan, 0.0, *studies::thread_queue(1));
  std::size_t bytes = 0;
  for (const results::TrialColumns& columns : pilot.columns) {
    bytes += columns.status.size();
    for (const std::vector<double>& metric : columns.metrics) bytes += sizeof(double) * metric.size();
  }
  return static_cast<double>(bytes);
}

}  // namespace

std::string size_text(double bytes) {
  constexpr std::array<const char*, 5> units = {"KiB", "MiB", "GiB", "TiB", "PiB"};
  double size = bytes / 1024.0;
  std::size_t unit = 0;
  for (; size >= 999.5 && unit + 1 < units.size(); ++unit) size /= 1024.0;
  return fmt::format("{:.3g} {}", size, units[unit]);
}

double free_bytes(const fs::path& folder) {
  std::error_code unknown;
  const fs::space_info space = fs::space(folder, unknown);
  return unknown ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available);
}

void require_room(const studies::Study& study, const studies::Plan& plan, const fs::path& output) {
  const double free = free_bytes(folder_of(output));
  const auto cells = static_cast<double>(plan.cells.size());
  const std::uint64_t trials = study.stop ? study.stop->max_trials : study.trials;
  const double kept = cells * static_cast<double>(std::min(trials, plan.header.kept_trials));
  const double totals = cells * static_cast<double>(plan.header.methods.size()) * bytes_of_totals;
  const auto there = static_cast<double>(results::stored_bytes(output));
  if (2.0 * (totals + kept * static_cast<double>(studies::bytes_per_trial(study))) - there <= free) return;

  const double values = kept > 0.0 ? kept * bytes_of_trial(study, plan) : 0.0;
  const double needed = totals + values;
  const std::string found =
      fmt::format("{}: takes about {}, {} of it values of single trials ([store] trial_columns_mib), and {} are free",
                  output.string(), size_text(needed), size_text(values), size_text(free));
  if (needed - there > free) throw core::InputError(found + "; make room, keep fewer trials, or choose another -o");
  if (2.0 * needed - there > free)
    say(fmt::format("warning: {}; until its parts are sealed it takes twice as much\n", found));
}

}  // namespace ridgeloc::app
