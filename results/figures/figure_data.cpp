#include "results/figures/figure_data.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "core/error.hpp"
#include "results/figures/figure_bounds.hpp"
#include "results/figures/figure_distribution.hpp"
#include "results/figures/figure_names.hpp"
#include "results/figures/figure_points.hpp"
#include "results/figures/figure_population.hpp"
#include "results/figures/figure_settings.hpp"
#include "results/figures/figure_texts.hpp"
#include "results/figures/horizontal_axis.hpp"
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

/// Of the distance of two categories, what the points of one take beside each other.
constexpr double share_of_category = 0.6;

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
        settings_(summary.header, names_),
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
    data.conditions = settings_.conditions();
    number_in_order(groups_, names_.group);
    number_in_order(facets_, names_.facet);
    name_groups(data);
    if (names_.x) {
      place_axis(data);
    } else if (!rows_.empty()) {
      place_distribution(data);
    }
    for (const auto& [metric, row] : rows_) add(data, metric, row);
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
  using Key = FigureSettings::Key;

  /// Numbers the values of some dimensions in the order of the grid, methods last, also where cells are left out.
  void number_in_order(std::map<Key, std::size_t>& numbers, const Key& dimensions) const {
    Key grid = dimensions;
    std::ranges::sort(grid);
    std::map<Key, Key> keys;
    for (const auto& [metric, row] : rows_)
      keys.emplace(settings_.key(row.cell, row.method, grid), settings_.key(row.cell, row.method, dimensions));
    for (const auto& entry : keys) numbers.emplace(entry.second, numbers.size());
  }

  /// Legend texts; of a single axis its values alone, below its name.
  void name_groups(FigureData& data) const {
    data.groups.resize(groups_.size());
    const bool is_one_axis = names_.group.size() == 1 && names_.group.front() != method_dimension;
    if (is_one_axis) data.group_title = settings_.title(names_.group.front());
    for (const auto& [values, group] : groups_)
      data.groups[group] = is_one_axis ? settings_.value_text(names_.group.front(), values.front())
                                       : settings_.label(names_.group, values);
  }

  void place_axis(FigureData& data) {
    HorizontalAxis axis = horizontal_axis(header_, spec_, names_, settings_, view_.log_x);
    data.x_label = settings_.title(*names_.x);
    data.log_x = axis.log;
    data.is_categorical = axis.is_categorical;
    data.x_ticks = std::move(axis.ticks);
    x_ = std::move(axis.positions);
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

  Key axes_of_group() const {
    Key axes = names_.group;
    std::erase(axes, method_dimension);
    return axes;
  }

  std::string facet_label(std::size_t facet) const {
    const auto found = std::ranges::find(facets_, facet, &std::pair<const Key, std::size_t>::second);
    return settings_.label(names_.facet, found->first);
  }

  /// Where a point stands: at its value, or beside others of its category.
  double place_of(const FigureData& data, std::size_t x_index, std::size_t group, std::size_t metric) const {
    if (!data.is_categorical) return x_[x_index];
    const auto places = static_cast<double>(groups_.size() * data.metrics.size());
    const auto place = static_cast<double>(group * data.metrics.size() + metric);
    return x_[x_index] + share_of_category * ((place + 0.5) / places - 0.5);
  }

  /// The panel of a facet and a scale; the scales of a facet stand beside each other.
  FigurePanel& panel_of(FigureData& data, std::size_t facet, std::size_t scale) const {
    while (data.panels.size() <= facet * scales_.size() + scale)
      data.panels.push_back({facet_label(data.panels.size() / scales_.size()), data.panels.size() % scales_.size()});
    return data.panels[facet * scales_.size() + scale];
  }

  void add(FigureData& data, std::size_t metric, const SummaryRow& row) {
    const std::size_t group = groups_.at(settings_.key(row.cell, row.method, names_.group));
    const std::size_t facet = facets_.at(settings_.key(row.cell, row.method, names_.facet));
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
      const FigurePoint point = figure_point(row, has_histogram ? histogram_of(row) : Histogram(), quantity,
                                             place_of(data, x_index, group, entry));
      if (std::isnan(point.y)) return;
      line->points.push_back(point);
      add_bound(row, facet, group, metric, x_[x_index]);
    }
    population_.add(row.n, summary_.of(row.cell, row.method).trials);
  }

  void add_bound(const SummaryRow& row, std::size_t facet, std::size_t group, std::size_t metric, double x) {
    const Key axes = axes_of_group();
    const Key values = settings_.key(row.cell, row.method, axes);
    std::vector<std::string> texts;
    for (std::size_t i = 0; i < axes.size(); ++i) texts.push_back(settings_.setting(axes[i], values[i]));
    bounds_.add(row, {facet * scales_.size() + scale_of_[metric], group, metric, x, values, std::move(texts)});
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
      if (!settings_.is_placed(i) && header_.axes[i].values.size() > 1)
        axes += (axes.empty() ? "" : ", ") + header_.axes[i].name;
    }
    throw core::InputError(
        fmt::format("figure '{}': several cells fall on one {}, among them {}; add to group or facet: {}", spec_.name,
                    names_.x ? "point" : "line", cell_text(header_, row.cell), axes));
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
    data.footnote =
        distribution_ ? population_.text_of_lines(data.style, largest_share_outside_) : population_.text_of_points();
    bounds_.finish(data);
    if (untrusted) data.footnote += "; dotted bars: the interval itself is uncertain";
    std::set<std::pair<std::size_t, std::size_t>> drawn;
    for (const auto& entry : rows_) drawn.emplace(entry.second.cell, entry.second.method);
    if (const std::string alarms = alarm_text(summary_, drawn); !alarms.empty()) data.footnote += "; " + alarms;
  }

  const Summary& summary_;
  const Header& header_;
  const FigureSpec& spec_;
  const FigureView& view_;
  FigureNames names_;
  FigureSettings settings_;
  FigureBounds bounds_;
  std::vector<std::pair<std::size_t, SummaryRow>> rows_;  ///< index into y, row
  std::vector<std::vector<Quantity>> scales_;             ///< quantities by the axis that they share
  std::vector<std::size_t> scale_of_;                     ///< per index into y
  std::vector<double> x_;
  std::optional<FigureDistribution> distribution_;
  double largest_share_outside_ = 0.0;
  std::map<Key, std::size_t> groups_;
  std::map<Key, std::size_t> facets_;
  std::map<Key, std::size_t> occupied_;
  FigurePopulation population_;
};

}  // namespace

FigureData figure_data(const Summary& summary, const FigureSpec& spec, const FigureView& view) {
  const Summary wider = with_ratios(summary);
  return Builder(wider, spec, view).build();
}

}  // namespace ridgeloc::results
