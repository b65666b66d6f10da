#pragma once

#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "results/figures/figure_names.hpp"
#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// Internal to figures: what one says of the settings of its cells, along its axis, in its legend, above its panels and
/// under its title. An axis of the sweep that it does not name and that moves along with one that it names, zipped with
/// it, stands beside that one.
class FigureSettings {
 public:
  /// Values of axes, as indices, or of the method.
  using Key = std::vector<std::size_t>;

  /// Both must outlive it. Groups and facets may gain the method later, but no axis.
  FigureSettings(const Header& header, const FigureNames& names);

  /// What a cell and a method have in some dimensions.
  Key key(std::size_t cell, std::size_t method, const Key& dimensions) const;

  /// Indices of the values of an axis that drawn cells have, ascending.
  const std::set<std::size_t>& drawn_values(std::size_t axis) const { return drawn_values_[axis]; }

  /// Whether the figure names the axis.
  bool is_placed(std::size_t axis) const;

  /// "points = 3", and "points = 3, range_sigma_m = 0.1" where the second axis moves along; of a method its label.
  std::string setting(std::size_t dimension, std::size_t value) const;

  /// "points = 3, rrr".
  std::string label(const Key& dimensions, const Key& values) const;

  /// A value where the axis is told beside it: "3", "3 (0.1)".
  std::string value_text(std::size_t axis, std::size_t value) const;

  /// What an axis is called where its values stand alone: "number of points (range noise [m])".
  std::string title(std::size_t axis) const;

  /// Axes that the figure does not name and in which the cells that it shows do not differ, unlike those of the study;
  /// and those in which they do, not by one of the axes that it names.
  std::string conditions() const;

 private:
  /// Indices of the values that an axis has beside each value of another, where that is one.
  using Companion = std::map<std::size_t, std::size_t>;

  void find_companions(std::size_t axis);
  Companion companion(std::size_t axis, std::size_t other) const;
  std::string value(std::size_t axis, std::size_t value) const;

  const Header& header_;
  const FigureNames& names_;
  std::vector<std::set<std::size_t>> drawn_values_;                     ///< per axis
  std::map<std::size_t, std::map<std::size_t, Companion>> companions_;  ///< by axis that is named, by the other
  std::set<std::size_t> accompanying_;                                  ///< axes that are a companion
};

}  // namespace ridgeloc::results
