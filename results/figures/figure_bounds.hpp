#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "results/figures/figure_data.hpp"
#include "results/figures/figure_names.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// Collects what bounds the points of a curve figure from below (`MetricInfo::bound`), and makes lines of it. For means
/// of what is chi-square in theory (`MetricInfo::chi_square`) it is the expected value with the band in which 95 % of
/// the means would lie, of the fewest values where points at one x have different numbers of them.
///
/// Where the figure shows root mean squares and the mean square of the bound is finite (`BoundKind`), that is the root
/// mean square of the bound; elsewhere its median, with its quartiles as a band if no panel has more than three of
/// them. A bound that several groups share, since it does not depend on the method or on what else tells them apart, is
/// drawn once: in the colour of the group that it belongs to, or in grey where it belongs to several.
class FigureBounds {
 public:
  FigureBounds(const Summary& summary, const FigureSpec& spec, const FigureNames& names);

  /// A point of the figure: its panel, group and metric, where it stands, and its values of those axes that tell groups
  /// apart, with a text for each.
  struct Place {
    std::size_t panel = 0;
    std::size_t group = 0;
    std::size_t metric = 0;  ///< index into the figure's y
    double x = 0.0;
    std::vector<std::size_t> axes;
    std::vector<std::string> texts;
  };
  /// Notes the bound of a point; nothing where the metric has none.
  void add(const SummaryRow& row, Place place);

  /// Adds all bounds to the panels, their legend texts, and what they are to the footnote.
  void finish(FigureData& data) const;

 private:
  struct Line {
    std::set<std::size_t> groups;
    std::vector<std::string> texts;  ///< of the axes that tell groups apart, those that all of its groups share
    std::map<double, FigurePoint> points;
  };
  /// Panel, values of the axes, bound metric, kind of statistic.
  struct Key {
    std::size_t panel;
    std::vector<std::size_t> axes;
    std::size_t metric;
    BoundKind kind;
    auto operator<=>(const Key&) const = default;
  };

  /// Takes another line into this one if it is the same wherever both have points. Returns whether it is.
  static bool unite(Line& line, const Line& other);
  /// All lines, equal ones once.
  std::vector<std::pair<Key, Line>> distinct_lines() const;

  void add_expectation(const SummaryRow& row, const Place& place);

  /// The metric that bounds another one, as an index into the schema; the number of metrics where it has none.
  std::size_t bound_of(const std::string& metric) const;

  const Summary& summary_;
  const FigureNames& names_;
  bool is_wanted_;
  std::map<Key, Line> lines_;
};

}  // namespace ridgeloc::results
