#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// What is reported of each cell and method, as tables and texts name it: the metrics, then the events.
struct Measure {
  enum class Lead { Mean, Median, Rate };  ///< the number that speaks for it
  std::string name;
  std::string unit;
  std::string description;
  Lead lead = Lead::Mean;
  bool is_metric = true;
  bool is_status = false;
  bool is_failure = false;
  bool is_alarm = false;
};
std::vector<Measure> measures_of(const Schema& schema);

/// The measure that a row of the summary is about.
const Measure& measure_of(const std::vector<Measure>& measures, const SummaryRow& row);

/// Name and unit: "error_m [m]".
std::string measure_title(const Measure& measure);

/// Whether a row carries a `!`: its error bar is not reliable itself. A rate of something never seen has a bound
/// instead of a bar.
bool is_flagged(const SummaryRow& row, const Measure& measure);

/// What the figures of the study show, in their order. A name that the schema has not is left out: drawing such a
/// figure says so.
std::vector<std::string> drawn_measures(const Header& header);

/// Whether a figure of the study shows the measure.
bool is_drawn(const Header& header, const std::string& measure);

/// Whether the method runs on trials, and is no mere label of what belongs to the scene: then it has statuses.
bool is_solver(const Summary& summary, std::size_t method);

/// How many of the trials failed, by the statuses of the schema.
std::uint64_t failed_trials(const Schema& schema, const Statistics& statistics);

/// What a row says of its measure: "0.223 [0.195, 0.251]" of a median or a rate, "0.545 ± 0.049" of a mean, "0 [≤
/// 0.0075]" of what never happened, "-" without values. Without the flag.
std::string estimate_text(const SummaryRow& row, Measure::Lead lead);

/// How such a text is to be read: "median [95 %]".
const char* estimate_kind(Measure::Lead lead);

/// How often something happened, as `estimate_text` has it: "0.0025 [0.0004, 0.0140]" or "0 [≤ 0.0075]".
std::string rate_text(std::uint64_t count, std::uint64_t trials);

}  // namespace ridgeloc::results
