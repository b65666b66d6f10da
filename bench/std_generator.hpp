#pragma once

#include <random>

#include "core/problem.hpp"

namespace ridgeloc::bench {

/// Scenes and measurements with the generator and the distributions of the C++ library: what one would write without
/// ridgeloc. The same distributions and columns as `generate`, other numbers, one sequence instead of numbers by
/// identity.
class StdGenerator {
 public:
  /// Fills a shaped batch with the next trials of the sequence.
  void generate(core::ProblemBatch& problems);

 private:
  std::mt19937_64 engine_{2018};
};

}  // namespace ridgeloc::bench
