#include "studies/study/axis_groups.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "core/error.hpp"

namespace ridgeloc::studies {

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

double crossed_cells(const Study& study) {
  double cells = 1.0;
  for (const auto& group : axis_groups(study)) cells *= static_cast<double>(study.sweep[group.front()].values.size());
  return cells;
}

void refuse_too_many_cells(const Study& study) {
  const double cells = crossed_cells(study);
  if (cells <= static_cast<double>(max_cells)) return;
  throw core::InputError(
      fmt::format("{}: its sweep crosses to {:.0f} cells; at most {} are allowed, so cut it in pieces", study.name,
                  cells, max_cells));
}

}  // namespace ridgeloc::studies
