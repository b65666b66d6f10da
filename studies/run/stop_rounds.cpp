#include "studies/run/stop_rounds.hpp"

#include <algorithm>
#include <iterator>

#include "studies/study/capabilities.hpp"

namespace ridgeloc::studies {

bool has_cost(const Study& study, const results::Header& header, std::size_t method) {
  return study.methods.empty() ? !header.methods[method].difference : method < study.methods.size();
}

StopRounds::StopRounds(const Study& study, const Plan& plan, const Assignment& assignment,
                       const FinishedBlocks& finished)
    : study_(study),
      plan_(plan),
      assignment_(assignment),
      finished_(finished),
      looks_(looks(*study.stop, assignment.block_trials)),
      known_(assignment.cells.size()) {}

FinishedBlocks::Extent StopRounds::extent(std::size_t place) const {
  return finished_.extent(assignment_.cells[place], assignment_.trials, assignment_.methods);
}

const StopRounds::Known& StopRounds::known(std::size_t place, std::uint64_t blocks) {
  Known& known = known_[place];
  if (known.blocks == blocks) return known;
  const std::size_t cell = assignment_.cells[place];
  std::vector<results::Statistics> statistics;
  double cost = 0.0;
  const Cell settings = plan_.cells[cell];
  for (std::size_t m = 0; m < plan_.header.methods.size(); ++m) {
    statistics.push_back(finished_.statistics(cell, m));
    if (has_cost(study_, plan_.header, m)) cost += cost_of(*study_.experiment, settings.values, statistics.back());
  }
  known = {blocks, cost, precision_of(*study_.stop, plan_.header, statistics)};
  return known;
}

std::vector<Stretch> StopRounds::next() {
  std::vector<Stretch> begun;    // cells between two looks, or before the first
  std::vector<Stretch> wanting;  // cells at a look that was not the last
  for (std::size_t place = 0; place < assignment_.cells.size(); ++place) {
    const auto [unbroken, end] = extent(place);
    const auto next = std::ranges::upper_bound(looks_, unbroken);
    if (next == looks_.end()) continue;
    const Stretch stretch{place, unbroken, *next};
    // Blocks beyond a look say that it was not enough.
    const bool at_look = next != looks_.begin() && *std::prev(next) == unbroken && end == unbroken;
    if (!at_look) {
      begun.push_back(stretch);
    } else if (!known(place, unbroken).precision.is_enough()) {
      wanting.push_back(stretch);
    }
  }
  if (study_.stop->max_cost > 0.0) return begun.empty() ? most_worthwhile(wanting) : begun;
  begun.insert(begun.end(), wanting.begin(), wanting.end());
  return begun;
}

std::vector<Stretch> StopRounds::most_worthwhile(const std::vector<Stretch>& wanting) {
  double spent = 0.0;
  for (std::size_t place = 0; place < assignment_.cells.size(); ++place) {
    const std::uint64_t blocks = extent(place).unbroken;
    spent += known(place, blocks).cost;
  }
  if (wanting.empty() || spent >= study_.stop->max_cost) return {};
  const auto priority_of = [&](const Stretch& stretch) {
    const Known& cell = known(stretch.place, stretch.first);
    return priority(cell.precision, cell.cost);
  };
  return {*std::ranges::max_element(wanting, {}, priority_of)};
}

}  // namespace ridgeloc::studies
