#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>

#include "app/exit_code.hpp"
#include "app/recomputation.hpp"
#include "app/result_probe.hpp"
#include "app/verbs.hpp"
#include "results/schema/text.hpp"
#include "results/store/result_file.hpp"
#include "studies/run/failure_audit.hpp"

namespace ridgeloc::app {

int audit(const AuditOptions& options) {
  const auto [header, study, plan] = recomputation_of(options.result);
  const auto ledger = read_probed(options.result, [&] { return results::read_result_ledger(options.result); });
  const std::uint64_t trials = options.trials.value_or(std::numeric_limits<std::uint64_t>::max());
  const studies::Experiment& experiment = *study.experiment;
  const auto first = experiment.prepare({study.seed, study.audit}, plan.cells[0], study.methods);
  static_cast<void>(studies::required<studies::FailureRecount>(experiment, *first));
  const auto counts = studies::audit_failures(study, plan, ledger, trials, *studies::thread_queue(options.threads));

  std::size_t width = 6;
  for (const studies::Method& method : study.methods) width = std::max(width, method.label.size());
  fmt::print("trials that failed, solved again by Ceres: with a minimum from the same start, and from the truth\n");
  for (std::size_t cell = 0; cell < plan.cells.size(); ++cell) {
    if (!header.axes.empty()) fmt::print("{}\n", results::cell_text(header, cell));
    fmt::print("  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}\n", "method", width, "trials", "failed", "from start",
               "from truth");
    for (std::size_t m = 0; m < study.methods.size(); ++m) {
      const studies::FailureCounts& c = counts[cell * study.methods.size() + m];
      const auto or_none = [&](std::uint64_t count) { return c.has_reference ? std::to_string(count) : "-"; };
      fmt::print("  {:<{}}  {:>10}  {:>10}  {:>10}  {:>10}\n", study.methods[m].label, width, c.trials, c.failed,
                 or_none(c.from_start), or_none(c.from_truth));
    }
  }
  return Success;
}

}  // namespace ridgeloc::app
