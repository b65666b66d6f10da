#pragma once

#include <cstdint>
#include <map>

namespace ridgeloc::results {

/// A set of block numbers, kept as its maximal runs.
class BlockSet {
 public:
  void insert(std::uint64_t first, std::uint64_t count);
  bool contains(std::uint64_t block) const;
  std::uint64_t size() const;

 private:
  std::map<std::uint64_t, std::uint64_t> runs_;  ///< first block -> one past the last
};

}  // namespace ridgeloc::results
