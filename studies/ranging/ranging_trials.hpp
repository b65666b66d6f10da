#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/problem.hpp"
#include "core/solution.hpp"
#include "studies/ranging/ranging_settings.hpp"
#include "studies/solving/audit.hpp"
#include "studies/solving/pieces.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// Scratch memory of the `ranging` experiment.
struct RangingScratch : Workspace {
  using Workspace::Workspace;

  core::ProblemBatch problems;
  core::SolutionBatch solutions;
  std::array<std::vector<double>, 3> truth;
  std::vector<double> image_distance;
  std::vector<double> values;
  std::vector<double> condition;
  std::vector<std::uint8_t> flags;
  Audit::Columns audit;
  PieceMemory piece;
};

/// Writes the problems of a range of trials into the scratch memory, by the kernels of its instruction set; what is
/// known about them refers to it too.
core::Oracle simulate_ranging(std::uint64_t seed, const RangingCell& settings, TrialRange range,
                              RangingScratch& scratch);

}  // namespace ridgeloc::studies
