#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace ridgeloc::tests {

/// What theory demands of a solver run to the end in a well-conditioned basin.
inline constexpr double largest_gap_allowed_m = 1e-8;

/// A solver without ridge (rrr: with K = 0), run to the end, against Ceres' minimiser over many trials.
struct Agreement {
  std::size_t trials = 0;
  std::size_t converged = 0;      ///< ours
  std::size_t reference = 0;      ///< of these, with a converged reference
  std::size_t same_basin = 0;     ///< of these, within 1 cm of it
  std::size_t conditioned = 0;    ///< of these, with cond(J'WJ) < 10^4
  std::size_t arrived = 0;        ///< of these, within `largest_gap_allowed_m`
  double largest_gap_m = 0.0;     ///< |x - x_ceres| over the well conditioned
  double largest_gradient = 0.0;  ///< |J'We| by Ceres at our estimate over what the largest gap allowed leaves
};
Agreement compare_with_ceres(const char* solver, std::size_t trials, std::size_t points, double sigma_m);

/// The step that a ridge solver takes when it starts at Ceres' minimiser.
struct StepAtMinimizer {
  std::string k;
  bool learns = false;  ///< from the least-squares step
  std::size_t trials = 0;
  std::size_t reference = 0;  ///< with a converged reference
  std::size_t singular = 0;   ///< of these, where the solver finds J'WJ singular and takes no step
  double largest_step_m = 0.0;
  double largest_ratio = 0.0;  ///< step over the step that the gradient's rounding bound allows
};
/// One for every estimator of K.
std::vector<StepAtMinimizer> steps_at_minimizer(const char* solver, std::size_t trials, std::size_t points,
                                                double sigma_m);

}  // namespace ridgeloc::tests
