#include "app/continuation.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

#include "app/instruction_set.hpp"
#include "app/output.hpp"
#include "app/result_probe.hpp"
#include "core/error.hpp"
#include "results/store/parts_folder.hpp"
#include "results/store/result_file.hpp"
#include "results/util/file_system.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/plan/union.hpp"
#include "studies/registry.hpp"

namespace ridgeloc::app {

namespace {

constexpr std::size_t most_differences = 4;

/// What to compute with: what the user asked for, or what the result was begun with.
core::Isa isa_of(const std::string& asked, const std::vector<results::Header>& headers, const std::string& output) {
  if (headers.empty()) return instruction_set(asked);
  const std::string& begun = headers.front().isa;
  if (begun == results::mixed_isa) {
    throw core::InputError(fmt::format(
        "{}: was merged from results of several instruction sets and cannot be continued; choose another -o", output));
  }
  if (!asked.empty() && asked != begun) {
    throw core::InputError(fmt::format("{}: was computed with the instruction set {}; choose another -o or --isa {}",
                                       output, begun, begun));
  }
  const auto isa = core::find_isa(begun);
  if (isa && core::is_supported(*isa)) return *isa;
  throw core::InputError(fmt::format(
      "{}: was begun with the instruction set {}, which this processor or build lacks; go on where it began, remove "
      "it, or choose another -o",
      output, begun));
}

}  // namespace

void require_shareable(const studies::Study& study) {
  if (study.stop) {
    throw core::InputError(
        fmt::format("{}: a share cannot know when a cell has enough trials; remove [stop] from the study, or run it "
                    "as a whole",
                    study.name));
  }
}

std::string difference_to(const studies::Study& study, const results::Header& found, const std::string& path) {
  if (found.experiment == study.experiment->name() && found.experiment_version != study.experiment->version()) {
    return fmt::format("was computed by version {} of the experiment {}, this program has {}", found.experiment_version,
                       found.experiment, study.experiment->version());
  }
  std::vector<std::string> texts = studies::differences(study_of(found, path), study);
  if (texts.empty()) return {};
  const std::size_t others = texts.size() - std::min(texts.size(), most_differences);
  texts.resize(std::min(texts.size(), most_differences));
  if (others > 0) texts.push_back(fmt::format("{} more", others));
  return fmt::format("holds another study ({})", fmt::join(texts, ", "));
}

studies::Study study_of(const results::Header& header, const std::string& path) {
  try {
    return studies::read_study({path, path, header.study_toml, false});
  } catch (const core::InputError& error) {
    throw core::InputError(
        fmt::format("{}: this program lacks what its study names, and cannot compute any of it: {}; "
                    "summary, plot, report and export show it all the same",
                    path, error.what()));
  }
}

Job continued(studies::Study study, const std::filesystem::path& output, const std::string& isa,
              const studies::Shard& shard) {
  if (shard.count > 1) require_shareable(study);
  const std::string path = output.string();
  const bool has_result = results::path_exists(output);
  if (has_result) probe(path, [&] { results::read_completely(path); });
  const std::vector<results::Header> headers = results::headers_at(output);
  Job job;
  job.output = output;
  job.study = study;
  for (std::size_t i = 0; i < headers.size(); ++i) {
    const std::string difference = difference_to(study, headers[i], path);
    if (!difference.empty())
      throw core::InputError(fmt::format("{}: {}; choose another -o or remove it", path, difference));
    studies::Study found = study_of(headers[i], path);
    // What a stopped run has not reached is nothing to keep.
    const bool is_part = i > 0 || !has_result;
    if (is_part) found.trials = std::min(found.trials, study.trials);
    job.study = studies::united(std::move(job.study), found);
  }
  const core::Isa set = isa_of(isa, headers, path);
  job.plan = studies::make_plan(job.study, set);
  // Without anything there it is all of the plan, which may have a million cells.
  const studies::Plan asked = headers.empty() ? studies::Plan() : studies::make_plan(study, set);
  job.assignment = studies::assignment_of(job.plan, headers.empty() ? job.plan : asked, shard);
  return job;
}

}  // namespace ridgeloc::app
