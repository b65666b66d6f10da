#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "studies/run/stop_rounds.hpp"

namespace ridgeloc::studies {

/// The order in which the blocks of some stretches are computed: in rounds over the stretches, so that a run that is
/// stopped has something of every cell.
///
/// A stretch is cut into pieces of some blocks. The first round takes one piece of each, and every later one as many as
/// all rounds before it together: 1, 1, 2, 4, ... So no cell is ever ahead of another by more than a factor of two and
/// a piece, and a worker changes the cell, which may be dear to prepare, only as often as the logarithm of the pieces
/// says. Nothing is kept of single pieces, of which there may be billions.
class BlockRounds {
 public:
  /// Precondition: piece_blocks > 0.
  BlockRounds(std::vector<Stretch> stretches, std::uint64_t piece_blocks);

  std::uint64_t pieces() const { return pieces_; }

  /// The piece with that number, counted from 0 in the order of computing; of a stretch that is shorter than others it
  /// may be empty.
  Stretch piece(std::uint64_t number) const;

 private:
  struct Round {
    std::uint64_t first = 0;  ///< number of its first piece
    std::uint64_t begin = 0;  ///< pieces of each stretch before it
    std::uint64_t size = 0;   ///< pieces of each stretch in it
  };

  std::vector<Stretch> stretches_;  ///< longest first
  std::uint64_t piece_blocks_;
  std::uint64_t pieces_ = 0;
  std::vector<Round> rounds_;
};

}  // namespace ridgeloc::studies
