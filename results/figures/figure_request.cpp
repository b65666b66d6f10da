#include "results/figures/figure_request.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <vector>

#include "core/error.hpp"
#include "results/figures/figure_names.hpp"

namespace ridgeloc::results {
namespace {

using Key = std::vector<std::size_t>;

/// Indices of the drawn cells, each one per axis.
std::vector<Key> drawn_cells(const Header& header, const std::vector<bool>& is_drawn) {
  std::vector<Key> cells;
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    if (is_drawn[cell]) cells.push_back(header.cells[cell].indices);
  }
  return cells;
}

bool is_placed(const FigureSpec& spec, const std::string& axis) {
  return axis == spec.x || axis == spec.facet || std::ranges::find(spec.group, axis) != spec.group.end();
}

/// The first axis in which the drawn cells differ, or the first one at all.
std::string default_x(const Header& header, const FigureSpec& spec, const std::vector<Key>& cells) {
  std::string first;
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
    const std::string& name = header.axes[axis].name;
    if (is_placed(spec, name)) continue;
    if (std::ranges::any_of(cells, [&](const Key& cell) { return cell[axis] != cells.front()[axis]; })) return name;
    if (first.empty()) first = name;
  }
  if (first.empty()) {
    throw core::InputError(
        fmt::format("figure '{}': the study sweeps no {}axis for x", spec.name, header.axes.empty() ? "" : "further "));
  }
  return first;
}

/// Axes that do not stand in the figure and without which two cells would have the same place in it.
std::vector<std::string> distinguishing_axes(const Header& header, const FigureSpec& spec,
                                             const std::vector<Key>& cells) {
  std::vector<std::size_t> placed;
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
    if (is_placed(spec, header.axes[axis].name)) placed.push_back(axis);
  }
  std::vector<std::string> names;
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
    if (is_placed(spec, header.axes[axis].name)) continue;
    std::map<Key, std::size_t> value_at;
    const bool is_needed = std::ranges::any_of(cells, [&](const Key& cell) {
      Key place;
      for (const std::size_t other : placed) place.push_back(cell[other]);
      return value_at.try_emplace(place, cell[axis]).first->second != cell[axis];
    });
    if (!is_needed) continue;
    names.push_back(header.axes[axis].name);
    placed.push_back(axis);
  }
  return names;
}

}  // namespace

FigureSpec completed_figure(const Header& header, FigureSpec spec) {
  const bool is_curve = spec.kind == "curve";
  if (spec.name.empty()) spec.name = fmt::format("{}{}", fmt::join(spec.y, "-"), is_curve ? "" : "-" + spec.kind);
  const auto cells = drawn_cells(header, cells_of_figure(header, spec));
  if (spec.x.empty() && is_curve) spec.x = default_x(header, spec, cells);
  if (spec.group.empty()) spec.group = distinguishing_axes(header, spec, cells);
  return spec;
}

}  // namespace ridgeloc::results
