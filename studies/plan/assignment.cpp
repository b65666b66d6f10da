#include "studies/plan/assignment.hpp"

#include <algorithm>
#include <bit>

#include "results/schema/places_by_hash.hpp"

namespace ridgeloc::studies {

namespace {

constexpr std::uint64_t runs_per_share = 16;

/// The places of the hashes of one list in another, ascending.
template <class Info>
std::vector<std::size_t> places_of(const std::vector<Info>& wanted, const std::vector<Info>& all) {
  const results::PlacesByHash known(all);
  std::vector<std::size_t> places;
  for (const Info& info : wanted)
    for (const std::size_t place : known.of(info.hash)) places.push_back(place);
  std::ranges::sort(places);
  const auto repeated = std::ranges::unique(places);
  places.erase(repeated.begin(), repeated.end());
  return places;
}

}  // namespace

TrialRange Assignment::range(std::uint64_t block) const {
  const std::uint64_t first = block * block_trials;
  return {first, static_cast<std::size_t>(std::min(block_trials, trials - first))};
}

std::uint64_t Assignment::run_blocks() const {
  return std::bit_floor(std::max<std::uint64_t>(1, blocks_per_cell() / (runs_per_share * shard.count)));
}

bool Assignment::contains(std::size_t place, std::uint64_t block) const {
  const std::uint64_t run = run_blocks();
  const std::uint64_t runs_per_cell = (blocks_per_cell() + run - 1) / run;
  return (place * runs_per_cell + block / run) % shard.count == shard.number - 1;
}

std::uint64_t Assignment::blocks(std::uint64_t per_cell) const {
  per_cell = std::min(per_cell, blocks_per_cell());
  if (shard.count == 1) return per_cell * cells.size();
  const std::uint64_t run = run_blocks();
  std::uint64_t sum = 0;
  for (std::size_t place = 0; place < cells.size(); ++place)
    for (std::uint64_t first = 0; first < per_cell; first += run)
      if (contains(place, first)) sum += std::min(run, per_cell - first);
  return sum;
}

Assignment everything(const Plan& plan) {
  return assignment_of(plan, plan, {});
}

Assignment assignment_of(const Plan& plan, const Plan& asked, const Shard& shard) {
  Assignment assignment;
  assignment.cells = places_of(asked.header.cells, plan.header.cells);
  assignment.methods = places_of(asked.header.methods, plan.header.methods);
  assignment.trials = asked.header.trials;
  assignment.block_trials = plan.header.block_trials;
  assignment.shard = shard;
  return assignment;
}

}  // namespace ridgeloc::studies
