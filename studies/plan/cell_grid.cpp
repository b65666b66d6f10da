#include "studies/plan/cell_grid.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include "studies/study/axis_groups.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::size_t nowhere = std::numeric_limits<std::size_t>::max();

/// A pattern of `exclude`: on some axes the place of a value.
using Pattern = std::vector<std::pair<std::size_t, std::size_t>>;

Pattern pattern_of(const Values& values, const std::vector<SweepAxis>& sweep,
                   const std::vector<std::vector<std::size_t>>& places) {
  Pattern pattern;
  for (std::size_t a = 0; a < sweep.size(); ++a) {
    const auto value = values.find(sweep[a].setting->name);
    if (value == values.end()) continue;
    const auto found = std::ranges::find(sweep[a].values, value->second);
    const auto number = static_cast<std::size_t>(found - sweep[a].values.begin());
    // What the axis has not, fits no cell.
    pattern.emplace_back(a, found == sweep[a].values.end() ? nowhere : places[a][number]);
  }
  return pattern;
}

/// Whether a cell, told by the numbers of its values, fits a pattern.
bool fits(const Pattern& pattern, const std::vector<std::size_t>& numbers,
          const std::vector<std::vector<std::size_t>>& places) {
  return std::ranges::all_of(pattern,
                             [&](const auto& item) { return places[item.first][numbers[item.first]] == item.second; });
}

}  // namespace

DistinctValues distinct_values(const SweepAxis& axis) {
  DistinctValues distinct;
  std::map<std::string, std::size_t> seen;
  for (const Value& value : axis.values) {
    const auto [place, is_new] = seen.emplace(to_toml(value), distinct.values.size());
    if (is_new) distinct.values.push_back(value);
    distinct.places.push_back(place->second);
  }
  return distinct;
}

CellGrid::CellGrid(const Study& study)
    : fixed_(study.fixed), sweep_(study.sweep), groups_(axis_groups(study)), size_(1) {
  for (const SweepAxis& axis : sweep_) places_.push_back(distinct_values(axis).places);
  for (const auto& group : groups_) size_ *= sweep_[group.front()].values.size();
  if (study.exclude.empty()) return;
  std::vector<Pattern> patterns;
  for (const Values& values : study.exclude) patterns.push_back(pattern_of(values, sweep_, places_));
  std::vector<std::size_t> numbers(sweep_.size());
  for (std::size_t position = 0; position < size_; ++position) {
    number_values(position, numbers);
    const auto leaves_out = [&](const Pattern& pattern) { return fits(pattern, numbers, places_); };
    if (std::ranges::none_of(patterns, leaves_out)) kept_.push_back(position);
  }
  size_ = kept_.size();
}

Cell CellGrid::operator[](std::size_t number) const {
  Cell cell{number, std::vector<std::size_t>(sweep_.size()), fixed_};
  move_to(number, cell);
  return cell;
}

void CellGrid::move_to(std::size_t number, Cell& cell) const {
  cell.index = number;
  number_values(position_of(number), cell.indices);
  for (std::size_t a = 0; a < sweep_.size(); ++a) {
    const std::size_t value = cell.indices[a];
    cell.values[sweep_[a].setting->name] = sweep_[a].values[value];
    cell.indices[a] = places_[a][value];
  }
}

bool CellGrid::has_any(const Values& values) const {
  const Pattern pattern = pattern_of(values, sweep_, places_);
  std::vector<std::size_t> numbers(sweep_.size());
  for (std::size_t number = 0; number < size_; ++number) {
    number_values(position_of(number), numbers);
    if (fits(pattern, numbers, places_)) return true;
  }
  return false;
}

std::size_t CellGrid::position_of(std::size_t number) const {
  return kept_.empty() ? number : kept_[number];
}

void CellGrid::number_values(std::size_t position, std::vector<std::size_t>& numbers) const {
  for (std::size_t g = groups_.size(); g-- > 0;) {
    const std::size_t size = sweep_[groups_[g].front()].values.size();
    for (const std::size_t axis : groups_[g]) numbers[axis] = position % size;
    position /= size;
  }
}

}  // namespace ridgeloc::studies
