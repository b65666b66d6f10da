#include "studies/plan/cell_grid.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace ridgeloc::studies {

namespace {

/// Groups of axes that move together: each zipped group, and every other axis for itself, by first axis.
std::vector<std::vector<std::size_t>> axis_groups(const Study& study) {
  const auto group_of = [&](const std::string& name) {
    return std::ranges::find_if(study.zip, [&](const auto& g) { return std::ranges::find(g, name) != g.end(); });
  };
  std::vector<std::vector<std::size_t>> groups;
  std::vector<const std::vector<std::string>*> zipped;
  for (std::size_t a = 0; a < study.sweep.size(); ++a) {
    const auto zip = group_of(study.sweep[a].setting->name);
    const auto known = zip == study.zip.end() ? zipped.end() : std::ranges::find(zipped, &*zip);
    if (known != zipped.end()) {
      groups[static_cast<std::size_t>(known - zipped.begin())].push_back(a);
    } else {
      groups.push_back({a});
      zipped.push_back(zip == study.zip.end() ? nullptr : &*zip);
    }
  }
  return groups;
}

/// A pattern of `exclude`: on some axes the number of a value.
using Pattern = std::vector<std::pair<std::size_t, std::size_t>>;

Pattern pattern_of(const Values& values, const std::vector<SweepAxis>& sweep) {
  Pattern pattern;
  for (std::size_t a = 0; a < sweep.size(); ++a) {
    const auto value = values.find(sweep[a].setting->name);
    if (value == values.end()) continue;
    const auto place = std::ranges::find(sweep[a].values, value->second);
    pattern.emplace_back(a, static_cast<std::size_t>(place - sweep[a].values.begin()));
  }
  return pattern;
}

bool fits(const Pattern& pattern, const std::vector<std::size_t>& indices) {
  return std::ranges::all_of(pattern, [&](const auto& item) { return indices[item.first] == item.second; });
}

}  // namespace

CellGrid::CellGrid(const Study& study)
    : fixed_(study.fixed), sweep_(study.sweep), groups_(axis_groups(study)), size_(1) {
  for (const auto& group : groups_) size_ *= sweep_[group.front()].values.size();
  if (study.exclude.empty()) return;
  std::vector<Pattern> patterns;
  for (const Values& values : study.exclude) patterns.push_back(pattern_of(values, sweep_));
  std::vector<std::size_t> indices(sweep_.size());
  for (std::size_t position = 0; position < size_; ++position) {
    place(position, indices);
    const auto leaves_out = [&](const Pattern& pattern) { return fits(pattern, indices); };
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
  place(kept_.empty() ? number : kept_[number], cell.indices);
  for (std::size_t a = 0; a < sweep_.size(); ++a)
    cell.values[sweep_[a].setting->name] = sweep_[a].values[cell.indices[a]];
}

bool CellGrid::has_any(const Values& values) const {
  const Pattern pattern = pattern_of(values, sweep_);
  std::vector<std::size_t> indices(sweep_.size());
  for (std::size_t number = 0; number < size_; ++number) {
    place(kept_.empty() ? number : kept_[number], indices);
    if (fits(pattern, indices)) return true;
  }
  return false;
}

void CellGrid::place(std::size_t position, std::vector<std::size_t>& indices) const {
  for (std::size_t g = groups_.size(); g-- > 0;) {
    const std::size_t size = sweep_[groups_[g].front()].values.size();
    for (const std::size_t axis : groups_[g]) indices[axis] = position % size;
    position /= size;
  }
}

}  // namespace ridgeloc::studies
