#pragma once

#include <cstddef>
#include <string>

#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// How much of what the study asks for a result has; a shard's has only its share.
struct Completeness {
  std::size_t cells = 0;
  std::size_t incomplete = 0;  ///< of these, with fewer trials than asked for of some method
  double share = 1.0;          ///< of the trials asked for that are there, over cells and methods
};
Completeness completeness_of(const Summary& summary);

/// Whether all that the study asks for is there, and sealed.
bool is_complete(const Summary& summary);

/// In words: "complete: 15 cells with 10000 trials each", or what is missing.
std::string completeness_text(const Summary& summary);

}  // namespace ridgeloc::results
