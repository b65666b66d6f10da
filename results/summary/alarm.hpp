#pragma once

#include <cstddef>
#include <set>
#include <string>
#include <utility>

#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// What a figure says of the checks on the cells and methods that it shows, for each alarm of the schema that was tried
/// at least once: "audited by Ceres: 900 checks, disagreements 0 (<= 0.33 %)". The bound is that of
/// `upper_bound_of_none`, or the upper end of Wilson's interval where there are some.
std::string alarm_text(const Summary& summary, const std::set<std::pair<std::size_t, std::size_t>>& cells_and_methods);

}  // namespace ridgeloc::results
