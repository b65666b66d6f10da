#include "results/block_set.hpp"

#include <algorithm>
#include <iterator>

namespace ridgeloc::results {

void BlockSet::insert(std::uint64_t first, std::uint64_t count) {
  if (count == 0) return;
  std::uint64_t end = first + count;
  auto run = runs_.upper_bound(first);
  if (run != runs_.begin() && std::prev(run)->second >= first) --run;
  while (run != runs_.end() && run->first <= end) {
    first = std::min(first, run->first);
    end = std::max(end, run->second);
    run = runs_.erase(run);
  }
  runs_.emplace(first, end);
}

bool BlockSet::contains(std::uint64_t block) const {
  const auto after = runs_.upper_bound(block);
  return after != runs_.begin() && block < std::prev(after)->second;
}

std::uint64_t BlockSet::size() const {
  std::uint64_t blocks = 0;
  for (const auto& [first, end] : runs_) blocks += end - first;
  return blocks;
}

}  // namespace ridgeloc::results
