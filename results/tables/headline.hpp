#pragma once

#include <cstddef>
#include <vector>

#include "results/summary/measure.hpp"
#include "results/tables/summary_choice.hpp"

namespace ridgeloc::results {

/// What speaks for a result, the most telling first: what the figures of the study show, then the metrics by which
/// methods are compared. Where there is neither, the first metric and the outcomes that are no failures.
std::vector<Measure> leading_measures(const Summary& summary);

/// Whether methods are compared by the measure, trial by trial: a difference of two has values of it.
bool is_compared(const Summary& summary, const Measure& measure);

/// The measures that a choice names, in its order; without names the leading ones that any of the chosen methods
/// reports, or else all that they report. A measure with a median leads with the mean where that is all there is,
/// because values are negative. Precondition: the schema has the names.
std::vector<Measure> chosen_measures(const Summary& summary, const SummaryChoice& choice);

/// Whether the method has a value of the measure in any of the cells.
bool reports(const Summary& summary, const std::vector<std::size_t>& cells, std::size_t method, const Measure& measure);

}  // namespace ridgeloc::results
