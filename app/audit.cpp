#include <fmt/format.h>

#include <algorithm>

#include "app/exit_code.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "core/isa.hpp"
#include "results/result_file.hpp"
#include "results/text.hpp"
#include "studies/failure_audit.hpp"
#include "studies/study_reader.hpp"

namespace ridgeloc::app {

int audit(const AuditOptions& options) {
  const results::Header header = results::read_result_header(options.result);
  const auto isa = core::find_isa(header.isa);
  if (!isa || !core::is_supported(*isa)) {
    throw core::InputError(fmt::format("{}: was computed with the instruction set {}, which this processor lacks",
                                       options.result, header.isa));
  }
  const studies::Study study = studies::read_study({options.result, options.result, header.study_toml});
  const studies::Plan plan = studies::make_plan(study, *isa);
  if (plan.header.study_hash != header.study_hash) {
    throw core::InputError(fmt::format("{}: was computed by another version of the experiment {}; run the study again",
                                       options.result, header.experiment));
  }
  const std::uint64_t trials = std::min(options.trials.value_or(study.trials), study.trials);
  const auto counts = studies::audit_failures(study, plan, trials, options.threads);

  std::size_t width = 6;
  for (const studies::Method& method : study.methods) width = std::max(width, method.label.size());
  fmt::print("trials that failed, solved again by Ceres: with a minimum from the same start, and from the truth\n");
  for (const studies::Cell& cell : plan.cells) {
    if (!header.axes.empty()) fmt::print("{}\n", results::cell_text(header, cell.index));
    fmt::print("  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}\n", "method", width, "trials", "failed", "from start",
               "from truth");
    for (std::size_t m = 0; m < study.methods.size(); ++m) {
      const studies::FailureCounts& c = counts[cell.index * study.methods.size() + m];
      const auto or_none = [&](std::uint64_t count) { return c.has_reference ? std::to_string(count) : "-"; };
      fmt::print("  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}\n", study.methods[m].label, width, c.trials, c.failed,
                 or_none(c.from_start), or_none(c.from_truth));
    }
  }
  return Success;
}

}  // namespace ridgeloc::app
