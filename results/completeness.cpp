#include "results/completeness.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace ridgeloc::results {

Completeness completeness_of(const Summary& summary) {
  Completeness completeness;
  completeness.pairs = summary.statistics.size();
  double present = 0.0;
  for (const Statistics& statistics : summary.statistics) {
    if (statistics.trials < summary.header.trials) ++completeness.incomplete;
    present += static_cast<double>(std::min(statistics.trials, summary.header.trials));
  }
  completeness.share =
      present / (static_cast<double>(summary.header.trials) * static_cast<double>(completeness.pairs));
  return completeness;
}

std::string completeness_text(const Summary& summary) {
  const Completeness completeness = completeness_of(summary);
  if (completeness.incomplete == 0)
    return fmt::format("complete: {} pairs of cell and method with {} trials each", completeness.pairs,
                       summary.header.trials);
  return fmt::format("incomplete: {} of {} pairs of cell and method have fewer than {} trials; {:.3g} % of the trials are "
                     "there",
                     completeness.incomplete, completeness.pairs, summary.header.trials, 100.0 * completeness.share);
}

}  // namespace ridgeloc::results
