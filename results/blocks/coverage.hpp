#pragma once

#include <cstdint>
#include <map>

namespace ridgeloc::results {

/// Which blocks there are of something, and with how many trials: runs of whole blocks, and single shorter ones.
class Coverage {
 public:
  /// Adds `count` blocks with `trials` trials in all. Precondition: all are whole, or it is one block.
  void insert(std::uint64_t first, std::uint64_t count, std::uint64_t trials, std::uint64_t block_trials);

  /// Whether the block is there with at least that many trials.
  bool contains(std::uint64_t block, std::uint64_t trials) const;

  /// How many of the blocks that `trials` trials make are there from the first on without a gap, the last one with what
  /// is left for it; more if there are more whole ones.
  std::uint64_t unbroken(std::uint64_t trials, std::uint64_t block_trials) const;
  /// One past the last block.
  std::uint64_t end() const;

  /// How many of the blocks that `trials` trials make are there, the last one with what is left for it.
  std::uint64_t count(std::uint64_t trials, std::uint64_t block_trials) const;

  /// Trials of all blocks.
  std::uint64_t trials(std::uint64_t block_trials) const;

  friend bool operator==(const Coverage&, const Coverage&) = default;

 private:
  bool contains_whole(std::uint64_t block) const;

  std::map<std::uint64_t, std::uint64_t> whole_;    ///< maximal runs: first block -> one past the last
  std::map<std::uint64_t, std::uint64_t> shorter_;  ///< block -> its trials
};

}  // namespace ridgeloc::results
