#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "app/duration.hpp"
#include "app/exit_code.hpp"
#include "app/output.hpp"
#include "app/result_probe.hpp"
#include "app/verbs.hpp"
#include "results/blocks/coverage.hpp"
#include "results/schema/text.hpp"
#include "results/store/parts_folder.hpp"
#include "results/store/run_record.hpp"
#include "results/store/snapshot.hpp"
#include "results/summary/measure.hpp"
#include "results/tables/fitted_table.hpp"
#include "results/tables/overview_tables.hpp"
#include "results/util/file_system.hpp"
#include "results/util/json.hpp"

namespace ridgeloc::app {

namespace {

namespace fs = std::filesystem;
using State = results::RunRecord::State;

constexpr std::size_t width = 100;

/// A run that goes on says so every two seconds; a machine may be busy.
constexpr double silent_after_s = 30.0;

/// What is on the disk, of all methods.
struct Kept {
  std::uint64_t blocks = 0;          ///< that all methods have
  std::uint64_t blocks_asked = 0;    ///< of all cells, by the trials that the study asks for
  std::uint64_t trials = 0;          ///< of these blocks
  std::uint64_t cells_begun = 0;     ///< with a block at least
  std::uint64_t cells_complete = 0;  ///< with all trials that the study asks for
};

Kept kept_of(const results::Snapshot& snapshot) {
  const results::Header& header = snapshot.header;
  const std::size_t methods = header.methods.size();
  std::vector<results::Coverage> there(header.cells.size() * methods);
  for (const results::Row& row : snapshot.ledger.rows()) {
    results::Coverage& coverage = there[row.cell * methods + row.method];
    coverage.insert(row.first_block, row.blocks, row.statistics.trials, header.block_trials);
  }
  const std::uint64_t asked = (header.trials + header.block_trials - 1) / header.block_trials;
  Kept kept;
  kept.blocks_asked = asked * header.cells.size();
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    std::uint64_t blocks = asked;
    std::uint64_t trials = header.trials;
    for (std::size_t m = 0; m < methods; ++m) {
      const results::Coverage& coverage = there[cell * methods + m];
      blocks = std::min(blocks, coverage.count(header.trials, header.block_trials));
      trials = std::min(trials, coverage.trials(header.block_trials));
    }
    kept.blocks += blocks;
    kept.trials += trials;
    if (blocks > 0) ++kept.cells_begun;
    if (blocks == asked) ++kept.cells_complete;
  }
  return kept;
}

/// All that is known of a result and the run that makes it.
struct Progress {
  std::string result;
  std::string state;  ///< "complete", "sealed", "running", "writing", "silent" or "stopped"
  std::optional<results::FoundRecord> run;
  std::optional<results::Summary> summary;  ///< none: nothing is on the disk yet
  Kept kept;

  /// As the run itself counts, which knows what it was asked for; else what is on the disk.
  std::uint64_t blocks_done() const { return run ? std::max(run->record.blocks_done, kept_blocks()) : kept.blocks; }
  std::uint64_t blocks_total() const { return run ? run->record.blocks_total : kept.blocks_asked; }
  std::uint64_t trials_done() const {
    if (!run) return kept.trials;
    // A run that was stopped at its beginning has not counted yet what was there.
    return std::max(run->record.trials_done + run->record.trials_found, std::min(kept.trials, trials_total()));
  }
  std::uint64_t trials_total() const {
    return run ? run->record.trials_total : summary->header.trials * summary->header.cells.size();
  }
  double rate() const {
    if (!run || run->record.seconds <= 0.0) return 0.0;
    return static_cast<double>(run->record.trials_done) / run->record.seconds;
  }
  /// None where the rate is not known.
  std::optional<double> left_s() const {
    if (rate() <= 0.0) return std::nullopt;
    return static_cast<double>(trials_total() - std::min(trials_done(), trials_total())) / rate();
  }

 private:
  std::uint64_t kept_blocks() const { return std::min(kept.blocks, run->record.blocks_total); }
};

std::string state_of(const Progress& progress, bool is_sealed) {
  if (!progress.run) {
    if (!is_sealed) return "stopped";
    return progress.kept.blocks == progress.kept.blocks_asked ? "complete" : "sealed";
  }
  if (progress.run->record.state == State::Stopped) return "stopped";
  if (progress.run->age_s > silent_after_s) return "silent";
  return progress.run->record.state == State::Writing ? "writing" : "running";
}

/// "r.h5" of "r.h5.parts" too.
std::string result_named(const std::string& name) {
  constexpr std::string_view folder = ".parts";
  const std::string plain = name.ends_with('/') ? name.substr(0, name.size() - 1) : name;
  return plain.ends_with(folder) ? plain.substr(0, plain.size() - folder.size()) : name;
}

Progress progress_of(const std::string& name) {
  Progress progress;
  progress.result = result_named(name);
  const fs::path folder = results::parts_folder(progress.result);
  progress.run = results::find_run_record(folder);
  const bool has_blocks = results::path_exists(progress.result) || !results::content_of(folder).parts.empty();
  if (!has_blocks && progress.run) {
    progress.state = state_of(progress, false);
    return progress;
  }
  const results::Snapshot snapshot = read_probed(
      progress.result, [&] { return results::read_snapshot(progress.result, results::SnapshotOf::ResultAndParts); });
  progress.summary = results::summarize(snapshot);
  progress.kept = kept_of(snapshot);
  // Otherwise it widens the result, and has not written a part yet.
  if (snapshot.is_sealed && progress.run && progress.run->record.state == State::Stopped) progress.run.reset();
  progress.state = state_of(progress, snapshot.is_sealed);
  return progress;
}

std::string state_text(const Progress& progress) {
  if (progress.state == "complete") return "complete";
  if (progress.state == "sealed")
    return "sealed, and lacks trials that the study asks for; the same command computes them";
  if (!progress.run) return "stopped; the same command goes on from there";
  const results::RunRecord& record = progress.run->record;
  const std::string where = fmt::format("process {} on {}, since {}, {}", record.process, record.machine, record.begun,
                                        results::count_text(record.workers, "thread"));
  const std::string ago = duration_text(progress.run->age_s);
  if (progress.state == "running") return fmt::format("running: {}", where);
  if (progress.state == "writing") return fmt::format("all is computed, and the result is being written: {}", where);
  if (progress.state == "stopped")
    return fmt::format("stopped {} ago; the same command goes on from there ({})", ago, where);
  return fmt::format("silent for {}: killed, or its machine asleep; the same command goes on from there ({})", ago,
                     where);
}

std::string percent(std::uint64_t part, std::uint64_t whole) {
  return whole == 0 ? "" : fmt::format(" ({:.3g} %)", 100.0 * static_cast<double>(part) / static_cast<double>(whole));
}

std::string text_of(const Progress& progress) {
  const auto line = [](const char* name, const std::string& text) {
    const std::string key = fmt::format("  {:<8} ", name);
    return key + results::wrapped_text(text, width - key.size(), key.size());
  };
  std::string text = results::wrapped_text(fmt::format("{}: {}", progress.result, state_text(progress)), width);
  if (progress.summary) {
    const results::Header& header = progress.summary->header;
    text += line("study", header.title.empty() ? header.experiment : header.title);
    text += line("cells", fmt::format("{} of {} complete, {} begun", progress.kept.cells_complete, header.cells.size(),
                                      progress.kept.cells_begun));
  }
  const std::string on_disk = fmt::format("; {} on the disk", progress.kept.blocks);
  text += line("blocks", fmt::format("{} of {}{}{}", progress.blocks_done(), progress.blocks_total(),
                                     percent(progress.blocks_done(), progress.blocks_total()),
                                     progress.state == "complete" ? "" : on_disk));
  text += line("trials", fmt::format("{} of {}{}", progress.trials_done(), progress.trials_total(),
                                     percent(progress.trials_done(), progress.trials_total())));
  if (progress.run) {
    const auto left = progress.left_s();
    text += line("rate", progress.rate() > 0.0 ? rate_text(progress.rate()) : "not known yet");
    const char* hint = progress.state == "running" ? "about" : "at that rate about";
    if (progress.state != "writing")
      text += line("left", left ? fmt::format("{} {}", hint, duration_text(*left)) : "not known yet");
  }
  if (!progress.summary) return text;
  const auto failures = results::failure_table(*progress.summary, results::whole(progress.summary->header));
  if (failures.rows.empty()) return text;
  return text + "\nFailures in the blocks on the disk:\n" + results::fitted_text(failures, width).text;
}

std::string json_of(const Progress& progress) {
  const auto number = [](std::optional<double> value) { return value ? results::json_number(*value) : "null"; };
  std::string text = fmt::format(
      "  {{\n    \"result\": {}, \"state\": \"{}\",\n    \"blocks_done\": {}, \"blocks_total\": {}, "
      "\"blocks_kept\": {},\n    \"trials_done\": {}, \"trials_total\": {}",
      results::json_string(progress.result), progress.state, progress.blocks_done(), progress.blocks_total(),
      progress.kept.blocks, progress.trials_done(), progress.trials_total());
  if (progress.summary)
    text += fmt::format(",\n    \"title\": {}, \"cells\": {}, \"cells_begun\": {}, \"cells_complete\": {}",
                        results::json_string(progress.summary->header.title), progress.summary->header.cells.size(),
                        progress.kept.cells_begun, progress.kept.cells_complete);
  if (progress.run) {
    const results::RunRecord& record = progress.run->record;
    text += fmt::format(
        ",\n    \"trials_per_s\": {}, \"left_s\": {}, \"process\": {}, \"machine\": {}, \"begun\": {}, \"threads\": "
        "{}, "
        "\"heard_of_s_ago\": {}",
        number(progress.rate()), number(progress.left_s()), record.process, results::json_string(record.machine),
        results::json_string(record.begun), record.workers, number(progress.run->age_s));
  }
  std::vector<std::string> failures;
  if (progress.summary) {
    const results::Summary& summary = *progress.summary;
    const results::SummaryChoice all = results::whole(summary.header);
    for (const std::size_t m : all.methods) {
      if (!results::is_solver(summary, m)) continue;
      const results::Failures sum = results::failures_of(summary, all, m);
      failures.push_back(fmt::format("{{\"method\": {}, \"trials\": {}, \"failed\": {}}}",
                                     results::json_string(summary.header.methods[m].label), sum.trials, sum.failed));
    }
  }
  return text + fmt::format(",\n    \"failures\": [{}]\n  }}", fmt::join(failures, ", "));
}

}  // namespace

int status(const StatusOptions& options) {
  std::vector<std::string> texts;
  for (const std::string& name : options.results) {
    const Progress progress = progress_of(name);
    texts.push_back(options.json ? json_of(progress) : text_of(progress));
  }
  if (options.json) {
    fmt::print("[\n{}\n]\n", fmt::join(texts, ",\n"));
  } else {
    fmt::print("{}", fmt::join(texts, "\n"));
  }
  return Success;
}

}  // namespace ridgeloc::app
