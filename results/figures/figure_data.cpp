#include "results/figures/figure_data.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <set>

#include "core/error.hpp"
#include "results/figures/figure_bounds.hpp"
#include "results/figures/figure_distribution.hpp"
#include "results/figures/figure_names.hpp"
#include "results/figures/figure_points.hpp"
#include "results/figures/figure_texts.hpp"
#include "results/schema/text.hpp"
#include "results/summary/alarm.hpp"
#include "results/summary/ratio.hpp"

namespace ridgeloc::results {
namespace {

using Quantity = FigureNames::Quantity;
using Statistic = FigureNames::Statistic;
constexpr std::size_t method_dimension = FigureNames::method_dimension;

/// More lines in a panel cannot be told apart.
constexpr std::size_t most_lines = 30;

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

bool is_positive(const Axis& axis) {
  return std::ranges::all_of(axis.values, [](const FactorValue& value) {
    const auto x = number(value);
    return x && *x > 0.0;
  });
}

bool spans_decades(const Axis& axis) {
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  for (const FactorValue& value : axis.values) {
    const auto x = number(value);
    low = std::min(low, x.value_or(0.0));
    high = std::max(high, x.value_or(0.0));
  }
  return is_positive(axis) && axis.values.size() > 2 && high >= 100.0 * low;
}

/// A picture of a run that goes on is not to be taken for its result.
std::string marked_incomplete(const std::string& title) {
  return fmt::format("{}{}incomplete: the run has not come to its end", title, title.empty() ? "" : "; ");
}

class Builder {
 public:
  Builder(const Summary& summary, const FigureSpec& spec, const FigureView& view)
      : summary_(summary),
        header_(summary.header),
        spec_(spec),
        view_(view),
        names_(resolve_figure_names(summary.header, spec)),
        bounds_(summary, spec, names_) {
    for (SummaryRow& row : summary_rows(summary)) {
      for (std::size_t metric = 0; metric < names_.y.size(); ++metric) {
        const Quantity& quantity = names_.y[metric];
        if (row.metric == quantity.name && is_drawn(row)) rows_.push_back({metric, row});
      }
    }
    group_by_method_if_needed();
    share_scales();
  }

  FigureData build() {
    FigureData data;
    data.view = view_;
    data.title = summary_.is_sealed ? spec_.title : marked_incomplete(spec_.title);
    data.conditions = conditions();
    if (names_.x) {
      place_axis(data, header_.axes[*names_.x]);
    } else if (!rows_.empty()) {
      place_distribution(data);
    }
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
    refuse_crowd(data);
    finish(data);
    return data;
  }

 private:
  using Key = std::vector<std::size_t>;

  void place_axis(FigureData& data, const Axis& axis) {
    data.x_label = axis_label(axis);
    data.log_x = view_.log_x || spans_decades(axis);
    if (data.log_x && !is_positive(axis)) {
      throw core::InputError(
          fmt::format("figure '{}': --log-x needs an axis of numbers above 0, and {} is none", spec_.name, axis.name));
    }
    x_ = positions(axis);
    for (const std::size_t i : drawn_values(*names_.x)) data.x_ticks.push_back({x_[i], factor_text(axis.values[i])});
    for (const std::vector<Quantity>& scale : scales_) {
      // Beside other quantities rates are not to be told from their logarithms.
      const bool log = spec_.log_y && (scales_.size() == 1 || scale.front().statistic != Statistic::Rate);
      data.scales.push_back({scale_label(scale), log});
    }
    data.metrics = has_metric_legend() ? quantity_texts(names_.y) : std::vector<std::string>{""};
  }

  /// Sorts the quantities by the vertical axes that they have.
  void share_scales() {
    for (const Quantity& quantity : names_.y) {
      const auto fits = [&](const std::vector<Quantity>& scale) { return share_scale(scale.front(), quantity); };
      auto scale = std::ranges::find_if(scales_, fits);
      if (scale == scales_.end()) scale = scales_.insert(scale, std::vector<Quantity>{});
      scale->push_back(quantity);
      scale_of_.push_back(static_cast<std::size_t>(scale - scales_.begin()));
    }
  }

  bool has_metric_legend() const { return scales_.size() < names_.y.size(); }

  void place_distribution(FigureData& data) {
    const Quantity& quantity = names_.y.front();
    const auto& info = *std::ranges::find(header_.schema.metrics, quantity.name, &MetricInfo::name);
    std::vector<const Histogram*> histograms;
    for (const auto& entry : rows_) {
      const SummaryRow& row = entry.second;
      if (row.min < 0.0) {
        throw core::InputError(fmt::format("figure '{}': kind = \"{}\" cannot show {} of {}, which has negative values",
                                           spec_.name, spec_.kind, quantity.name, header_.methods[row.method].label));
      }
      if (row.n > 0) histograms.push_back(&histogram_of(row));
    }
    distribution_.emplace(names_.kind, info.whole_numbers, histograms);
    data.x_label = with_unit(description_of(quantity), quantity.unit);
    data.scales = {{distribution_->y_label(), spec_.log_y}};
    data.log_x = true;
    data.x_ticks = distribution_->ticks();
    data.metrics = {""};
    data.style = names_.kind == FigureNames::Kind::Ecdf ? FigureStyle::Bands : FigureStyle::Lines;
  }

  const Histogram& histogram_of(const SummaryRow& row) const {
    const auto& metrics = header_.schema.metrics;
    const auto index = std::ranges::find(metrics, row.metric, &MetricInfo::name) - metrics.begin();
    return summary_.of(row.cell, row.method).metrics[static_cast<std::size_t>(index)].histogram;
  }

  bool is_drawn(const SummaryRow& row) const {
    return names_.is_drawn[row.cell] &&
           std::find(names_.methods.begin(), names_.methods.end(), row.method) != names_.methods.end();
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

  /// Indices of the values of an axis that drawn cells have, ascending.
  std::set<std::size_t> drawn_values(std::size_t axis) const {
    std::set<std::size_t> values;
    for (std::size_t cell = 0; cell < header_.cells.size(); ++cell) {
      if (names_.is_drawn[cell]) values.insert(header_.cells[cell].indices[axis]);
    }
    return values;
  }

  /// Those axes that the figure does not name and in which the cells that it shows do not differ, unlike those of the
  /// study.
  std::string conditions() const {
    std::string text;
    for (std::size_t axis = 0; axis < header_.axes.size(); ++axis) {
      if (is_placed(axis) || header_.axes[axis].values.size() < 2) continue;
      const std::set<std::size_t> values = drawn_values(axis);
      if (values.size() == 1) text += (text.empty() ? "" : ", ") + label({axis}, {*values.begin()});
    }
    return text;
  }

  bool is_placed(std::size_t axis) const {
    return axis == names_.x || key_contains(names_.group, axis) || key_contains(names_.facet, axis);
  }

  Key axes_of_group() const {
    Key axes = names_.group;
    std::erase(axes, method_dimension);
    return axes;
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

  /// Index of `values`' label, in order of first appearance: rows come in order of the grid.
  std::size_t enter(std::map<Key, std::size_t>& seen, std::vector<std::string>& labels, const Key& dimensions,
                    const Key& values) const {
    const auto [entry, is_new] = seen.try_emplace(values, labels.size());
    if (is_new) labels.push_back(label(dimensions, values));
    return entry->second;
  }

  /// The panel of a facet and a scale; the scales of a facet stand beside each other.
  FigurePanel& panel_of(FigureData& data, std::size_t facet, std::size_t scale) const {
    while (data.panels.size() <= facet * scales_.size() + scale)
      data.panels.push_back({facet_labels_[data.panels.size() / scales_.size()], data.panels.size() % scales_.size()});
    return data.panels[facet * scales_.size() + scale];
  }

  void add(FigureData& data, std::size_t metric, const SummaryRow& row) {
    const std::size_t group = enter(groups_, data.groups, names_.group, key(row, names_.group));
    const std::size_t facet = enter(facets_, facet_labels_, names_.facet, key(row, names_.facet));
    std::vector<FigureLine>& lines = panel_of(data, facet, scale_of_[metric]).lines;
    const std::size_t entry = has_metric_legend() ? metric : 0;
    auto line = std::find_if(lines.begin(), lines.end(),
                             [&](const FigureLine& l) { return l.group == group && l.metric == entry; });
    if (line == lines.end()) line = lines.insert(lines.end(), FigureLine{group, entry, {}});

    const std::size_t x_index = names_.x ? header_.cells[row.cell].indices[*names_.x] : 0;
    if (!occupied_.insert({Key{facet, group, metric, x_index}, row.cell}).second) refuse_overlap(row);
    if (distribution_) {
      if (row.n == 0) return;
      line->points = distribution_->points(histogram_of(row));
      largest_share_outside_ = std::max(largest_share_outside_, distribution_->share_outside(histogram_of(row)));
    } else {
      const Quantity& quantity = names_.y[metric];
      const bool has_histogram = quantity.statistic == Statistic::Quantile && row.n > 0;
      const FigurePoint point =
          figure_point(row, has_histogram ? histogram_of(row) : Histogram(), quantity, x_[x_index]);
      if (std::isnan(point.y)) return;
      line->points.push_back(point);
      const Key axes = axes_of_group();
      const Key values = key(row, axes);
      bounds_.add(row,
                  {facet * scales_.size() + scale_of_[metric], group, metric, point.x, values, label(axes, values)});
    }
    fewest_trials_ = std::min(fewest_trials_, row.n);
    most_trials_ = std::max(most_trials_, row.n);
    if (const std::uint64_t all = summary_.of(row.cell, row.method).trials; all > 0)
      smallest_share_ = std::min(smallest_share_, static_cast<double>(row.n) / static_cast<double>(all));
  }

  void refuse_crowd(const FigureData& data) const {
    for (const FigurePanel& panel : data.panels) {
      if (panel.lines.size() <= most_lines) continue;
      std::string axes;
      for (const std::size_t dimension : names_.group) {
        axes += (axes.empty() ? "" : ", ");
        axes += dimension == method_dimension ? "method" : header_.axes[dimension].name;
      }
      throw core::InputError(fmt::format(
          "figure '{}': {} lines in one panel cannot be told apart (at most {}); give one of {} a panel for each value "
          "(facet), or show fewer (where, methods)",
          spec_.name, panel.lines.size(), most_lines, axes));
    }
  }

  [[noreturn]] void refuse_overlap(const SummaryRow& row) const {
    std::string axes;
    for (std::size_t i = 0; i < header_.axes.size(); ++i) {
      if (!is_placed(i) && header_.axes[i].values.size() > 1) axes += (axes.empty() ? "" : ", ") + header_.axes[i].name;
    }
    throw core::InputError(
        fmt::format("figure '{}': several cells fall on one {}, among them {}; add to group or facet: {}", spec_.name,
                    names_.x ? "point" : "line", cell_text(header_, row.cell), axes));
  }

  static bool key_contains(const Key& dimensions, std::size_t dimension) {
    return std::find(dimensions.begin(), dimensions.end(), dimension) != dimensions.end();
  }

  void finish(FigureData& data) const {
    bool untrusted = false;
    for (FigurePanel& panel : data.panels) {
      if (panel.lines.size() > most_bands && data.style == FigureStyle::Bands) data.style = FigureStyle::Lines;
      for (FigureLine& line : panel.lines) {
        std::ranges::stable_sort(line.points, {}, &FigurePoint::x);
        for (const FigurePoint& point : line.points) untrusted = untrusted || !point.trusted;
      }
    }
    std::sort(data.x_ticks.begin(), data.x_ticks.end(),
              [](const FigureTick& a, const FigureTick& b) { return a.position < b.position; });
    data.footnote = footnote(data.style);
    bounds_.finish(data);
    if (untrusted) data.footnote += "; dotted bars: the interval itself is uncertain";
    std::set<std::pair<std::size_t, std::size_t>> drawn;
    for (const auto& entry : rows_) drawn.emplace(entry.second.cell, entry.second.method);
    if (const std::string alarms = alarm_text(summary_, drawn); !alarms.empty()) data.footnote += "; " + alarms;
  }

  std::string footnote(FigureStyle style) const {
    const std::string trials = fewest_trials_ >= most_trials_ ? fmt::format("{}", most_trials_)
                                                              : fmt::format("{} to {}", fewest_trials_, most_trials_);
    if (!distribution_) {
      const std::string share = smallest_share_ < 1.0
                                    ? fmt::format(" ({:.2g} % or more of those that were run)", 100.0 * smallest_share_)
                                    : "";
      return fmt::format("{} trials per point{}; bars: 95 % intervals; points share trials and are not independent",
                         trials, share);
    }
    std::string text = trials + " values per line";
    if (style == FigureStyle::Bands) text += "; bands: 95 % intervals at each place";
    if (largest_share_outside_ > 0.0) {
      text += fmt::format("; outside of the axis: at most {:.2g} % of a line", 100.0 * largest_share_outside_);
    }
    return text + "; lines share trials and are not independent";
  }

  const Summary& summary_;
  const Header& header_;
  const FigureSpec& spec_;
  const FigureView& view_;
  FigureNames names_;
  FigureBounds bounds_;
  std::vector<std::pair<std::size_t, SummaryRow>> rows_;  ///< index into y, row
  std::vector<std::vector<Quantity>> scales_;             ///< quantities by the axis that they share
  std::vector<std::size_t> scale_of_;                     ///< per index into y
  std::vector<double> x_;
  std::optional<FigureDistribution> distribution_;
  double largest_share_outside_ = 0.0;
  std::map<Key, std::size_t> groups_;
  std::map<Key, std::size_t> facets_;
  std::vector<std::string> facet_labels_;
  std::map<Key, std::size_t> occupied_;
  std::uint64_t fewest_trials_ = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t most_trials_ = 0;
  double smallest_share_ = 1.0;  ///< of the trials that were run, in the population of a point
};

}  // namespace

FigureData figure_data(const Summary& summary, const FigureSpec& spec, const FigureView& view) {
  const Summary wider = with_ratios(summary);
  return Builder(wider, spec, view).build();
}

}  // namespace ridgeloc::results
