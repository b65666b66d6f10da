#include "results/summary/alarm.hpp"

#include <fmt/core.h>

#include <cstdint>

#include "results/statistics/interval.hpp"

namespace ridgeloc::results {

std::string alarm_text(const Summary& summary, const std::set<std::pair<std::size_t, std::size_t>>& cells_and_methods) {
  const Schema& schema = summary.header.schema;
  std::string text;
  for (std::size_t i = 0; i < schema.metrics.size(); ++i) {
    if (schema.metrics[i].alarm.empty()) continue;
    std::uint64_t trials = 0;
    std::uint64_t disagreements = 0;
    for (const auto& [cell, method] : cells_and_methods) {
      const Statistics& statistics = summary.of(cell, method);
      if (i >= statistics.metrics.size()) continue;
      trials += statistics.metrics[i].moments.n;
      disagreements += yes_count(statistics.metrics[i]);
    }
    if (trials == 0) continue;
    const double bound = disagreements == 0 ? upper_bound_of_none(trials) : wilson_interval(disagreements, trials).hi;
    text += fmt::format("{}{}: {} checks, disagreements {} (<= {:.2g} %)", text.empty() ? "" : "; ",
                        schema.metrics[i].alarm, trials, disagreements, 100.0 * bound);
  }
  return text;
}

}  // namespace ridgeloc::results
