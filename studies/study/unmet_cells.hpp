#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "results/summary/summary.hpp"
#include "studies/study/stop_rule.hpp"

namespace ridgeloc::studies {

/// A cell that has trials and is not known as well as the rule asks for.
struct UnmetCell {
  std::size_t cell = 0;
  std::uint64_t trials = 0;
  Precision precision;
};

/// Of a result, in the order of its cells. Precondition: its header is that of the study with the rule.
std::vector<UnmetCell> unmet_cells(const StopRule& rule, const results::Summary& summary);

}  // namespace ridgeloc::studies
