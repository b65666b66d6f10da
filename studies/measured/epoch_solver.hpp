#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/isa.hpp"
#include "core/problem.hpp"
#include "core/solution.hpp"
#include "solvers/solver.hpp"
#include "studies/measured/covariance.hpp"
#include "studies/measured/epoch.hpp"
#include "studies/measured/epoch_geometry.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// What a method says about an epoch.
struct Fix {
  std::string status;  ///< a name of `core::status_names`, or "too_few_objects"; a position that is not "converged" is
                       ///< where the method stopped
  std::optional<Place> position;  ///< m; nothing of too few objects
  double iterations = 0.0;
  double residual_rms_m = 0.0;
  bool is_settled = false;  ///< converged, and the undamped step that is left is shorter than the tolerance, or than a
                            ///< tenth of the standard deviation
  std::vector<double> residuals_m;  ///< measured minus computed range, in the order of the readings
  Uncertainty uncertainty;          ///< of a position that is settled
};

/// Solves epochs with the methods of a study of ranges.
class EpochSolver {
 public:
  struct Known {
    std::optional<Place> start;     ///< where all methods start, or the height where that is known; absent: as they
                                    ///< say, or what `EpochGeometry` has
    std::optional<double> sigma_m;  ///< standard deviation of the ranges; absent: from their residuals
  };

  /// Throws core::InputError for a study that sweeps, is not about ranges, or has a method that needs the truth.
  EpochSolver(const Study& study, Known known, core::Isa isa);

  std::size_t methods() const { return methods_.size(); }
  const std::string& label(std::size_t method) const { return methods_[method].label; }
  bool knows_height() const { return knows_height_; }

  /// The answers to some epochs, by method and epoch. Coordinates are taken from an origin near the objects, so that
  /// large ones lose nothing. What an epoch comes to does not depend on the others.
  std::vector<std::vector<Fix>> solve(std::span<const Epoch> epochs, std::span<const EpochGeometry> geometries);

 private:
  struct SolvedMethod {
    std::string label;
    std::string solver;
    solvers::SolverOptions options;
  };

  void fill(std::span<const Epoch> epochs, std::span<const EpochGeometry> geometries,
            std::span<const std::size_t> some);
  Fix fix_of(const SolvedMethod& method, const Epoch& epoch, std::size_t slot) const;

  Known known_;
  core::Isa isa_;
  bool knows_height_ = false;
  std::vector<SolvedMethod> methods_;
  core::ProblemBatch problems_;
  core::SolutionBatch solutions_;
};

}  // namespace ridgeloc::studies
