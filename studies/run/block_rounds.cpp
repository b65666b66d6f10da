#include "studies/run/block_rounds.hpp"

#include <algorithm>
#include <utility>

namespace ridgeloc::studies {

BlockRounds::BlockRounds(std::vector<Stretch> stretches, std::uint64_t piece_blocks)
    : stretches_(std::move(stretches)), piece_blocks_(piece_blocks) {
  const auto pieces_of = [&](const Stretch& s) { return (s.end - s.first + piece_blocks_ - 1) / piece_blocks_; };
  // Then those that a round still concerns are the first ones.
  std::ranges::stable_sort(stretches_, std::ranges::greater(), pieces_of);
  const std::uint64_t longest = stretches_.empty() ? 0 : pieces_of(stretches_.front());
  for (std::uint64_t begin = 0; begin < longest;) {
    const std::uint64_t size = std::min(std::max<std::uint64_t>(begin, 1), longest - begin);
    const auto concerned =
        std::ranges::partition_point(stretches_, [&](const Stretch& s) { return pieces_of(s) > begin; });
    rounds_.push_back({pieces_, begin, size});
    pieces_ += static_cast<std::uint64_t>(concerned - stretches_.begin()) * size;
    begin += size;
  }
}

Stretch BlockRounds::piece(std::uint64_t number) const {
  const Round& round = *std::prev(std::ranges::upper_bound(rounds_, number, {}, &Round::first));
  const std::uint64_t within = number - round.first;
  const Stretch& stretch = stretches_[within / round.size];
  const std::uint64_t first = stretch.first + (round.begin + within % round.size) * piece_blocks_;
  return {stretch.place, std::min(first, stretch.end), std::min(first + piece_blocks_, stretch.end)};
}

}  // namespace ridgeloc::studies
