#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/problem.hpp"
#include "core/status.hpp"

namespace ridgeloc::core {

/// What a solver answers for a batch of problems: structure of arrays, indexed by trial.
///
/// After `reshape` every status is "not run" and the other columns are unspecified until a solver has written them. It
/// allocates only when the batch grows. Not synchronized.
struct SolutionBatch {
  std::array<std::vector<double>, position_parameters> estimate;  ///< position (m); the last finite iterate
  std::vector<double> image_distance_mm;  ///< v, where it is an unknown; otherwise what it was taken for
  std::vector<std::uint8_t> status;       ///< a `Status` per trial
  std::vector<double> iterations;         ///< steps computed, the last one included
  std::vector<double> residual_rms_m;     ///< sqrt(sum e_j^2 / n) at the estimate
  std::vector<double> remaining_step_m;   ///< |(J'WJ)^-1 J'We| at the estimate, with the solver's own weights and no
                                          ///< damping: zero at a stationary point, infinite where J'WJ is singular
  std::vector<double> eta_first;          ///< similarity of K to the true K at the start (NaN: no K or no oracle)
  std::vector<double> eta_last;           ///< ... at the last iteration
  std::vector<double> eta_mean;           ///< ... averaged over the iterations

  void reshape(std::size_t trials);

  std::size_t trials() const { return status.size(); }
};

}  // namespace ridgeloc::core
