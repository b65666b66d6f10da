#include "results/blocks/coverage.hpp"

#include <algorithm>
#include <iterator>

namespace ridgeloc::results {

void Coverage::insert(std::uint64_t first, std::uint64_t count, std::uint64_t trials, std::uint64_t block_trials) {
  if (count == 0) return;
  if (trials < count * block_trials) {
    if (!contains_whole(first)) shorter_[first] = std::max(shorter_[first], trials);
    return;
  }
  shorter_.erase(shorter_.lower_bound(first), shorter_.lower_bound(first + count));
  std::uint64_t end = first + count;
  auto run = whole_.upper_bound(first);
  if (run != whole_.begin() && std::prev(run)->second >= first) --run;
  while (run != whole_.end() && run->first <= end) {
    first = std::min(first, run->first);
    end = std::max(end, run->second);
    run = whole_.erase(run);
  }
  whole_.emplace(first, end);
}

bool Coverage::contains_whole(std::uint64_t block) const {
  const auto after = whole_.upper_bound(block);
  return after != whole_.begin() && block < std::prev(after)->second;
}

bool Coverage::contains(std::uint64_t block, std::uint64_t trials) const {
  if (contains_whole(block)) return true;
  const auto found = shorter_.find(block);
  return found != shorter_.end() && found->second >= trials;
}

std::uint64_t Coverage::unbroken(std::uint64_t trials, std::uint64_t block_trials) const {
  const std::uint64_t whole = whole_.empty() || whole_.begin()->first > 0 ? 0 : whole_.begin()->second;
  const std::uint64_t rest = trials % block_trials;
  const bool has_rest = rest > 0 && whole == trials / block_trials && contains(whole, rest);
  return has_rest ? whole + 1 : whole;
}

std::uint64_t Coverage::end() const {
  const std::uint64_t whole = whole_.empty() ? 0 : whole_.rbegin()->second;
  const std::uint64_t shorter = shorter_.empty() ? 0 : shorter_.rbegin()->first + 1;
  return std::max(whole, shorter);
}

std::uint64_t Coverage::count(std::uint64_t trials, std::uint64_t block_trials) const {
  const std::uint64_t whole_blocks = trials / block_trials;
  const std::uint64_t rest = trials % block_trials;
  std::uint64_t sum = rest > 0 && contains(whole_blocks, rest) ? 1 : 0;
  for (const auto& [first, end] : whole_) sum += std::min(end, whole_blocks) - std::min(first, whole_blocks);
  return sum;
}

std::uint64_t Coverage::trials(std::uint64_t block_trials) const {
  std::uint64_t sum = 0;
  for (const auto& [first, end] : whole_) sum += (end - first) * block_trials;
  for (const auto& [block, trials] : shorter_) sum += trials;
  return sum;
}

}  // namespace ridgeloc::results
