#include "results/figure_data.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "results/alarm.hpp"
#include "results/figure_names.hpp"
#include "results/text.hpp"

namespace ridgeloc::results {
namespace {

using Quantity = FigureNames::Quantity;
using Statistic = FigureNames::Statistic;
constexpr std::size_t method_dimension = FigureNames::method_dimension;

/// Of a median; that of a mean stands in its row.
constexpr std::uint64_t fewest_for_median = 10;

/// Descriptions that are longer would leave the figure; the name then stands for them.
constexpr std::size_t longest_legend_text = 45;

std::string with_unit(const std::string& text, const std::string& unit) {
  return unit == "1" || unit.empty() ? text : fmt::format("{} [{}]", text, unit);
}

std::string axis_label(const Axis& axis) {
  return with_unit(axis.description.empty() ? axis.name : axis.description, axis.unit);
}

const char* statistic_text(const Quantity& quantity) {
  switch (quantity.statistic) {
    case Statistic::Mean:
      return "mean";
    case Statistic::Median:
      return "median";
    case Statistic::RootMeanSquare:
      return "root mean square";
    case Statistic::Rate:
      return "rate";
  }
  return "";
}

std::string quantity_label(const Quantity& quantity) {
  const std::string text = quantity.description.empty() ? quantity.name : quantity.description;
  return with_unit(fmt::format("{}, {}", text, statistic_text(quantity)), quantity.unit);
}

std::optional<double> number(const FactorValue& value) {
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return static_cast<double>(*integer);
  if (const auto* real = std::get_if<double>(&value)) return *real;
  return std::nullopt;
}

/// Where each value of an axis stands: itself, or its index when any of them is a text.
std::vector<double> positions(const Axis& axis) {
  std::vector<double> result;
  for (const FactorValue& value : axis.values) {
    if (const auto x = number(value)) result.push_back(*x);
  }
  if (result.size() == axis.values.size()) return result;
  result.clear();
  for (std::size_t i = 0; i < axis.values.size(); ++i) result.push_back(static_cast<double>(i));
  return result;
}

bool spans_decades(const Axis& axis) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const FactorValue& value : axis.values) {
    const auto x = number(value);
    if (!x || *x <= 0.0) return false;
    low = std::min(low, *x);
    high = std::max(high, *x);
  }
  return axis.values.size() > 2 && high >= 100.0 * low;
}

FigurePoint point_of(const SummaryRow& row, const Quantity& quantity, double x) {
  if (quantity.statistic == Statistic::Median)
    return {x, row.p50, row.p50_lo, row.p50_hi, row.n >= fewest_for_median};
  if (quantity.statistic == Statistic::RootMeanSquare) return {x, row.rms, row.rms_lo, row.rms_hi, row.trusted};
  return {x, row.mean, row.lo, row.hi, row.trusted};
}

class Builder {
 public:
  Builder(const Summary& summary, const FigureSpec& spec)
      : summary_(summary), header_(summary.header), spec_(spec), names_(resolve_figure_names(summary.header, spec)) {
    for (SummaryRow& row : summary_rows(summary)) {
      for (std::size_t metric = 0; metric < names_.y.size(); ++metric) {
        const Quantity& quantity = names_.y[metric];
        if (row.metric == quantity.name && is_drawn(row.method)) rows_.push_back({metric, row});
      }
    }
    group_by_method_if_needed();
  }

  FigureData build() {
    const Axis& axis = header_.axes[names_.x];
    FigureData data;
    data.title = spec_.title;
    data.x_label = axis_label(axis);
    data.log_x = spans_decades(axis);
    data.log_y = spec_.log_y;
    x_ = positions(axis);
    for (std::size_t i = 0; i < x_.size(); ++i) data.x_ticks.push_back({x_[i], factor_text(axis.values[i])});
    label_quantities(data);
    for (const auto& [metric, row] : rows_) add(data, metric, row);
    if (grouped_by_one_axis()) {
      const Axis& grouping = header_.axes[names_.group.front()];
      data.group_title = axis_label(grouping);
      for (const auto& [values, group] : groups_) data.groups[group] = factor_text(grouping.values[values.front()]);
    }
    if (data.panels.empty()) {
      throw core::InputError(
          fmt::format("figure '{}': none of its methods reports {}; `ridgeloc summary` lists what there is", spec_.name,
                      spec_.y.front()));
    }
    finish(data);
    return data;
  }

 private:
  using Key = std::vector<std::size_t>;

  bool is_drawn(std::size_t method) const {
    return std::find(names_.methods.begin(), names_.methods.end(), method) != names_.methods.end();
  }

  void group_by_method_if_needed() {
    const auto names_method = [](const Key& dimensions) {
      return std::find(dimensions.begin(), dimensions.end(), method_dimension) != dimensions.end();
    };
    if (names_method(names_.group) || names_method(names_.facet)) return;
    const bool several = std::any_of(rows_.begin(), rows_.end(), [&](const auto& entry) {
      return entry.second.method != rows_.front().second.method;
    });
    if (several) names_.group.push_back(method_dimension);
  }

  Key key(const SummaryRow& row, const Key& dimensions) const {
    Key result;
    for (const std::size_t dimension : dimensions) {
      result.push_back(dimension == method_dimension ? row.method : header_.cells[row.cell].indices[dimension]);
    }
    return result;
  }

  bool grouped_by_one_axis() const { return names_.group.size() == 1 && names_.group.front() != method_dimension; }

  /// "points = 3, rrr".
  std::string label(const Key& dimensions, const Key& values) const {
    std::string text;
    for (std::size_t i = 0; i < dimensions.size(); ++i) {
      if (i > 0) text += ", ";
      if (dimensions[i] == method_dimension) {
        text += header_.methods[values[i]].label;
      } else {
        const Axis& axis = header_.axes[dimensions[i]];
        text += fmt::format("{} = {}", axis.name, factor_text(axis.values[values[i]]));
      }
    }
    return text;
  }

  void label_quantities(FigureData& data) const {
    if (names_.y.size() == 1) {
      data.y_label = quantity_label(names_.y.front());
      data.metrics = {""};
      return;
    }
    const Quantity& first = names_.y.front();
    const bool alike = std::all_of(names_.y.begin(), names_.y.end(), [&](const Quantity& quantity) {
      return quantity.unit == first.unit && quantity.statistic == first.statistic;
    });
    if (alike) data.y_label = with_unit(statistic_text(first), first.unit);
    for (const Quantity& quantity : names_.y) {
      const bool fits = !quantity.description.empty() && quantity.description.size() <= longest_legend_text;
      data.metrics.push_back(!fits ? quantity.name : alike ? quantity.description : quantity_label(quantity));
    }
  }

  /// Index of `values`' label, in order of first appearance: rows come in order of the grid.
  std::size_t enter(std::map<Key, std::size_t>& seen, std::vector<std::string>& labels, const Key& dimensions,
                    const Key& values) const {
    const auto [entry, is_new] = seen.try_emplace(values, labels.size());
    if (is_new) labels.push_back(label(dimensions, values));
    return entry->second;
  }

  void add(FigureData& data, std::size_t metric, const SummaryRow& row) {
    const std::size_t group = enter(groups_, data.groups, names_.group, key(row, names_.group));
    const std::size_t facet = enter(facets_, facet_labels_, names_.facet, key(row, names_.facet));
    if (facet == data.panels.size()) data.panels.push_back({facet_labels_[facet], {}});
    std::vector<FigureLine>& lines = data.panels[facet].lines;
    auto line = std::find_if(lines.begin(), lines.end(),
                             [&](const FigureLine& l) { return l.group == group && l.metric == metric; });
    if (line == lines.end()) line = lines.insert(lines.end(), FigureLine{group, metric, {}});

    const std::size_t x_index = header_.cells[row.cell].indices[names_.x];
    if (!occupied_.insert({Key{facet, group, metric, x_index}, row.cell}).second) refuse_overlap(row);
    const FigurePoint point = point_of(row, names_.y[metric], x_[x_index]);
    if (std::isnan(point.y)) return;
    line->points.push_back(point);
    fewest_trials_ = std::min(fewest_trials_, row.n);
    most_trials_ = std::max(most_trials_, row.n);
  }

  [[noreturn]] void refuse_overlap(const SummaryRow& row) const {
    std::string axes;
    for (std::size_t i = 0; i < header_.axes.size(); ++i) {
      const bool used = i == names_.x || key_contains(names_.group, i) || key_contains(names_.facet, i);
      if (!used && header_.axes[i].values.size() > 1) axes += (axes.empty() ? "" : ", ") + header_.axes[i].name;
    }
    throw core::InputError(
        fmt::format("figure '{}': several cells fall on one point, among them {}; add to group or facet: {}",
                    spec_.name, cell_text(header_, row.cell), axes));
  }

  static bool key_contains(const Key& dimensions, std::size_t dimension) {
    return std::find(dimensions.begin(), dimensions.end(), dimension) != dimensions.end();
  }

  void finish(FigureData& data) const {
    bool untrusted = false;
    for (FigurePanel& panel : data.panels) {
      for (FigureLine& line : panel.lines) {
        std::sort(line.points.begin(), line.points.end(),
                  [](const FigurePoint& a, const FigurePoint& b) { return a.x < b.x; });
        for (const FigurePoint& point : line.points) untrusted = untrusted || !point.trusted;
      }
    }
    std::sort(data.x_ticks.begin(), data.x_ticks.end(),
              [](const FigureTick& a, const FigureTick& b) { return a.position < b.position; });
    const std::string trials = fewest_trials_ >= most_trials_
                                   ? fmt::format("{} trials per point", most_trials_)
                                   : fmt::format("{} to {} trials per point", fewest_trials_, most_trials_);
    data.footnote = trials + "; bars: 95 % intervals; points share trials and are not independent";
    if (untrusted) data.footnote += "; dotted bars: the interval itself is uncertain";
    std::set<std::pair<std::size_t, std::size_t>> drawn;
    for (const auto& entry : rows_) drawn.emplace(entry.second.cell, entry.second.method);
    if (const std::string alarms = alarm_text(summary_, drawn); !alarms.empty()) data.footnote += "; " + alarms;
  }

  const Summary& summary_;
  const Header& header_;
  const FigureSpec& spec_;
  FigureNames names_;
  std::vector<std::pair<std::size_t, SummaryRow>> rows_;  ///< index into y, row
  std::vector<double> x_;
  std::map<Key, std::size_t> groups_;
  std::map<Key, std::size_t> facets_;
  std::vector<std::string> facet_labels_;
  std::map<Key, std::size_t> occupied_;
  std::uint64_t fewest_trials_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t most_trials_ = 0;
};

}  // namespace

FigureData figure_data(const Summary& summary, const FigureSpec& spec) {
  return Builder(summary, spec).build();
}

}  // namespace ridgeloc::results
