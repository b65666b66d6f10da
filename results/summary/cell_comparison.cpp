#include "results/summary/cell_comparison.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/error.hpp"
#include "results/schema/axis_values.hpp"
#include "results/schema/text.hpp"
#include "results/statistics/interval.hpp"

namespace ridgeloc::results {
namespace {

/// Fewer say nothing of a correlation.
constexpr std::uint64_t fewest_paired = 10;

struct Correlation {
  double value = undefined_value;
  std::uint64_t trials = 0;
};

/// Of the kept trials' values less the means of all; those that are not in the moments count as no deviation.
Correlation correlation_of(const TrialTable& a, const TrialTable& b, std::size_t metric, double mean_a, double mean_b) {
  const auto has_values = [metric](const TrialTable& t) {
    return metric < t.metrics.size() && !t.metrics[metric].empty();
  };
  if (!has_values(a) || !has_values(b)) return {};
  const auto deviation = [metric](const TrialTable& table, std::size_t row, double mean) {
    const double value = table.metrics[metric][row];
    return std::abs(value) <= largest_moment_value ? value - mean : 0.0;
  };
  double aa = 0.0;
  double bb = 0.0;
  double ab = 0.0;
  std::uint64_t common = 0;
  for (std::size_t i = 0, j = 0; i < a.trial.size() && j < b.trial.size();) {
    if (a.trial[i] != b.trial[j]) {
      ++(a.trial[i] < b.trial[j] ? i : j);
      continue;
    }
    const double da = deviation(a, i++, mean_a);
    const double db = deviation(b, j++, mean_b);
    aa += da * da;
    bb += db * db;
    ab += da * db;
    ++common;
  }
  if (common < fewest_paired || aa == 0.0 || bb == 0.0) return {};
  return {ab / std::sqrt(aa * bb), common};
}

Estimate difference_of_means(const Moments& a, const Moments& b, double covariance) {
  if (a.n < 2 || b.n < 2) return {undefined_value, undefined_value, undefined_value, undefined_value};
  const double variance = std::pow(mean_standard_error(a), 2) + std::pow(mean_standard_error(b), 2) - 2.0 * covariance;
  // Zero in theory where the two differ by a constant; rounding may put it below.
  const double error = std::sqrt(std::max(variance, 0.0));
  const double half = student_quantile_975(std::min(a.n, b.n) - 1) * error;
  const double difference = a.mean - b.mean;
  return {difference, error, difference - half, difference + half};
}

bool is_complete(const Summary& summary, std::size_t cell, std::size_t method) {
  return summary.of(cell, method).trials >= summary.header.trials;
}

/// The cell that differs in the axis alone and has the value there.
std::optional<std::size_t> base_of(const Header& header, std::size_t cell, const AxisValue& base) {
  std::vector<std::size_t> indices = header.cells[cell].indices;
  if (indices[base.axis] == base.value) return std::nullopt;
  indices[base.axis] = base.value;
  const auto found = std::ranges::find(header.cells, indices, &CellInfo::indices);
  if (found == header.cells.end()) return std::nullopt;
  return static_cast<std::size_t>(found - header.cells.begin());
}

/// All metrics of one method in two cells.
void compare(const Summary& summary, CellComparison pair, const TrialTable& first, const TrialTable& second,
             std::vector<CellComparison>& comparisons) {
  const Statistics& a = summary.of(pair.cell, pair.method);
  const Statistics& b = summary.of(pair.against, pair.method);
  const auto& metrics = summary.header.schema.metrics;
  for (pair.metric = 0; pair.metric < std::min(a.metrics.size(), b.metrics.size()); ++pair.metric) {
    const Moments& of_a = a.metrics[pair.metric].moments;
    const Moments& of_b = b.metrics[pair.metric].moments;
    if (metrics[pair.metric].yes_no || of_a.n == 0 || of_b.n == 0) continue;
    pair.n = of_a.n;
    pair.n_against = of_b.n;
    const bool same_trials =
        is_complete(summary, pair.cell, pair.method) && is_complete(summary, pair.against, pair.method);
    const Correlation correlation =
        same_trials ? correlation_of(first, second, pair.metric, of_a.mean, of_b.mean) : Correlation();
    pair.correlation = correlation.value;
    pair.paired = correlation.trials;
    double covariance = 0.0;
    if (pair.paired > 0) {
      const auto [fewer, more] = std::minmax({static_cast<double>(a.trials), static_cast<double>(b.trials)});
      covariance = correlation.value * mean_standard_error(of_a) * mean_standard_error(of_b) * std::sqrt(fewer / more);
    }
    pair.difference = difference_of_means(of_a, of_b, covariance);
    pair.ratio = ratio_of_means(of_a, of_b, covariance);
    const std::string& name = metrics[pair.metric].name;
    pair.trusted = summary_row(summary.header, pair.method, a, name).trusted &&
                   summary_row(summary.header, pair.method, b, name).trusted && is_ratio_linear(of_b);
    comparisons.push_back(pair);
  }
}

}  // namespace

AxisValue axis_value(const Header& header, std::string_view text) {
  AxisValues chosen;
  add_axis_values(chosen, text);
  const auto& [name, values] = *chosen.begin();
  std::vector<std::string> names;
  for (const Axis& axis : header.axes) names.push_back(axis.name);
  const auto axis = std::ranges::find(names, name);
  if (axis == names.end())
    throw core::InputError(fmt::format("{}: no axis \"{}\" (allowed: {})", text, name, fmt::join(names, ", ")));
  AxisValue result{static_cast<std::size_t>(axis - names.begin()), 0};
  const std::vector<FactorValue>& all = header.axes[result.axis].values;
  const auto value =
      std::ranges::find_if(all, [&](const FactorValue& one) { return is_written_as(one, values.front()); });
  if (value == all.end() || values.size() > 1) {
    std::vector<std::string> texts;
    for (const FactorValue& one : all) texts.push_back(factor_text(one));
    throw core::InputError(fmt::format("{}: not one value of {} (allowed: {})", text, name, fmt::join(texts, ", ")));
  }
  result.value = static_cast<std::size_t>(value - all.begin());
  return result;
}

std::vector<CellComparison> compare_cells(const Summary& summary, const AxisValue& base, const TrialReader& trials) {
  const Header& header = summary.header;
  std::vector<CellComparison> comparisons;
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    const auto against = base_of(header, cell, base);
    if (!against) continue;
    for (std::size_t method = 0; method < header.methods.size(); ++method) {
      compare(summary, {cell, *against, method, 0, 0, 0, {}, {}, undefined_value, 0, false}, trials(cell, method),
              trials(*against, method), comparisons);
    }
  }
  if (comparisons.empty()) {
    const Axis& axis = header.axes[base.axis];
    throw core::InputError(fmt::format("no two cells differ in {} alone, one of them with {}; choose another axis",
                                       axis.name, factor_text(axis.values[base.value])));
  }
  return comparisons;
}

}  // namespace ridgeloc::results
