#include "bench/check.hpp"

#include <algorithm>
#include <cstdio>

#include "bench/answer.hpp"
#include "bench/ours.hpp"
#include "bench/peer.hpp"
#include "bench/stop.hpp"
#include "bench/workload.hpp"

namespace ridgeloc::bench {

namespace {

/// Minima of one problem lie metres apart; answers nearer than this (m) belong to the same one.
constexpr double basin_m = 1.0;

/// Least shares that pass. Local methods part at a ridge between two basins, the more often the fewer points there are;
/// and a short step is no proof of being near where the problem is ill-conditioned, or where, as in TinySolver, the
/// last step is not taken. A wrong residual or Jacobian leaves next to nothing of either share.
constexpr double least_same_basin = 0.9;
constexpr double least_near = 0.95;

struct Gaps {
  double both_converged;  ///< share of the trials
  double same_basin;      ///< share of those
  double near;            ///< share of those: within `step_tolerance_m` of the minimum
  double median_m;        ///< median gap of the trials in the same basin
};

Gaps compare(const PeerEntry& entry, const ProblemSet& problems, const std::vector<Answer>& minima) {
  const auto peer = entry.make(problems);
  std::vector<double> gaps;
  double both = 0.0;
  for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
    const Answer answer = peer->solve(trial);
    if (!answer.converged || !minima[trial].converged) continue;
    both += 1.0;
    const double gap = distance(answer.estimate, minima[trial].estimate);
    if (gap < basin_m) gaps.push_back(gap);
  }
  std::ranges::sort(gaps);
  const double same = static_cast<double>(gaps.size());
  const double near = static_cast<double>(std::ranges::lower_bound(gaps, step_tolerance_m) - gaps.begin());
  return {both / static_cast<double>(problems.trials()), same / both, near / same,
          gaps.empty() ? basin_m : gaps[gaps.size() / 2]};
}

}  // namespace

bool check_peers() {
  bool good = true;
  std::printf("%-24s %6s %9s %10s %12s %12s\n", "peer", "points", "converged", "same basin", "within 5 cm",
              "median gap");
  for (const std::size_t points : point_counts) {
    const Workload& fixed = workload(points);
    const auto minima = least_squares_minima(fixed.batch);
    for (const PeerEntry& entry : peers()) {
      const Gaps gaps = compare(entry, fixed.problems, minima);
      std::printf("%-24.*s %6zu %8.2f%% %9.2f%% %11.2f%% %10.1e m\n", static_cast<int>(entry.name.size()),
                  entry.name.data(), points, 100.0 * gaps.both_converged, 100.0 * gaps.same_basin, 100.0 * gaps.near,
                  gaps.median_m);
      good = good && gaps.same_basin >= least_same_basin && gaps.near >= least_near;
    }
  }
  std::puts(good ? "every peer solves our problem" : "at least one peer does not solve our problem");
  return good;
}

}  // namespace ridgeloc::bench
