#pragma once

#include <array>
#include <span>

namespace ridgeloc::bench {

/// What any solver, ours or a peer, says about one problem.
struct Answer {
  std::array<double, 3> estimate;  ///< position (m)
  double steps;                    ///< computed, rejected ones and the last one included
  bool converged;                  ///< by the solver's own judgement, not by its iteration limit
};

/// What stands beside every time, because a solver that stops early looks fast.
struct Accuracy {
  double steps;        ///< mean over all trials
  double rms_error_m;  ///< root mean square distance from the truth over all trials, each clipped at `clip_m`
  double converged;    ///< share of trials
};

/// Where a trial's error is clipped: the objects' largest distance. Without it a handful of diverged trials, 10^5 m
/// away, would be all that the root mean square shows; without the failed trials a solver that gives up would gain.
inline constexpr double clip_m = 10.0;

Accuracy accuracy(std::span<const Answer> answers);

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b);

}  // namespace ridgeloc::bench
