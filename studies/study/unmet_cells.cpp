#include "studies/study/unmet_cells.hpp"

#include <algorithm>

namespace ridgeloc::studies {

std::vector<UnmetCell> unmet_cells(const StopRule& rule, const results::Summary& summary) {
  const std::size_t methods = summary.header.methods.size();
  std::vector<UnmetCell> unmet;
  for (std::size_t cell = 0; cell < summary.header.cells.size(); ++cell) {
    std::vector<results::Statistics> statistics;
    for (std::size_t m = 0; m < methods; ++m) statistics.push_back(summary.of(cell, m));
    const auto most = std::ranges::max_element(statistics, {}, &results::Statistics::trials);
    if (most == statistics.end() || most->trials == 0) continue;
    const Precision precision = precision_of(rule, summary.header, statistics);
    if (!precision.is_enough()) unmet.push_back({cell, most->trials, precision});
  }
  return unmet;
}

}  // namespace ridgeloc::studies
