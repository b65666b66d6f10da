#include "results/summary/completeness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

#include "results/schema/text.hpp"

namespace ridgeloc::results {

Completeness completeness_of(const Summary& summary) {
  const std::size_t methods = summary.header.methods.size();
  const std::uint64_t asked = summary.header.trials;
  Completeness completeness;
  completeness.cells = summary.header.cells.size();
  double present = 0.0;
  for (std::size_t cell = 0; cell < completeness.cells; ++cell) {
    bool is_complete = true;
    for (std::size_t method = 0; method < methods; ++method) {
      const std::uint64_t trials = std::min(summary.of(cell, method).trials, asked);
      is_complete = is_complete && trials == asked;
      present += static_cast<double>(trials);
    }
    if (!is_complete) ++completeness.incomplete;
  }
  completeness.share = present / (static_cast<double>(asked) * static_cast<double>(completeness.cells * methods));
  return completeness;
}

bool is_complete(const Summary& summary) {
  return summary.is_sealed && completeness_of(summary).incomplete == 0;
}

std::string completeness_text(const Summary& summary) {
  const Completeness completeness = completeness_of(summary);
  const std::string cells = count_text(completeness.cells, "cell");
  if (!summary.is_sealed && completeness.incomplete == 0)
    return "incomplete: all trials are there, and the result has not been written from its parts; the same command "
           "does";
  if (!summary.is_sealed)
    return fmt::format(
        "incomplete: the run has not come to its end; {} of {} lack some of {} trials; {:.3g} % of all "
        "trials are there",
        completeness.incomplete, cells, summary.header.trials, 100.0 * completeness.share);
  if (completeness.incomplete == 0) {
    std::uint64_t most = summary.header.trials;
    for (const Statistics& statistics : summary.statistics) most = std::max(most, statistics.trials);
    const std::string more = most > summary.header.trials ? fmt::format(" to {}", most) : "";
    return fmt::format("complete: {} with {}{} trials each", cells, summary.header.trials, more);
  }
  return fmt::format("incomplete: {} of {} lack some of {} trials; {:.3g} % of all trials are there",
                     completeness.incomplete, cells, summary.header.trials, 100.0 * completeness.share);
}

}  // namespace ridgeloc::results
