#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/problem.hpp"
#include "core/status.hpp"
#include "results/pictures/drawing.hpp"
#include "solvers/kernels/trace.hpp"
#include "solvers/options.hpp"
#include "studies/solving/audit.hpp"

namespace ridgeloc::studies {

/// The way of one method, for the picture.
struct RangingPath {
  std::string label;
  std::vector<solvers::TracedIterate> iterates;
  core::Status status = core::Status::NotRun;
  double steps = 0.0;                       ///< taken
  std::optional<Audit::Answers> reference;  ///< of its objective, if it has one
};

/// The scene of the trial in slot 0 from above, x to the right and y up: objects, truth, start, the paths, where Ceres
/// ends from the start and from the truth, and contours of least squares through the height of its minimiser. `shared`
/// are the options of the study's [solver].
results::Drawing ranging_drawing(const core::ProblemBatch& problems, const core::Oracle& oracle,
                                 const solvers::SolverOptions& shared, const std::vector<RangingPath>& paths);

}  // namespace ridgeloc::studies
