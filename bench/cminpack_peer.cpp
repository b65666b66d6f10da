#include <cminpack.h>

#include <vector>

#include "bench/peer.hpp"
#include "bench/range_model.hpp"
#include "bench/stop.hpp"

namespace ridgeloc::bench {

namespace {

/// MINPACK's lmder1. Its one tolerance is relative, for the cost and for x at once, so no value of it matches our stop
/// rule; iterations and errors tell how near "loose" comes.
class CminpackPeer : public Peer {
 public:
  CminpackPeer(const ProblemSet& problems, double tolerance)
      : problems_(problems),
        tolerance_(tolerance),
        residuals_(problems.points()),
        jacobian_(problems.points() * 3),
        work_(std::size_t{5} * 3 + problems.points()) {}

  Answer solve(std::size_t trial) override {
    std::array<double, 3> x = problems_.start(trial);
    Problem problem{problems_.observations(trial), 0};
    const int points = static_cast<int>(problems_.points());
    int pivots[3];
    const int info = lmder1(residuals_or_jacobian, &problem, points, 3, x.data(), residuals_.data(), jacobian_.data(),
                            points, tolerance_, pivots, work_.data(), static_cast<int>(work_.size()));
    // 1 to 4 are its ways of converging; 6 and 7 say that the tolerance asked for is below rounding.
    const bool converged = info >= 1 && info <= 7 && info != 5;
    return {x, problem.evaluations - 1.0, converged};
  }

 private:
  struct Problem {
    std::span<const Observation> observations;
    int evaluations;  ///< of the residuals: at the start, and after every step
  };

  static int residuals_or_jacobian(void* data, int, int, const double* x, double* residuals, double* jacobian, int,
                                   int flag) {
    auto& problem = *static_cast<Problem*>(data);
    if (flag == 1) {
      ++problem.evaluations;
      evaluate<Order::ColumnMajor>(problem.observations, x, residuals, nullptr);
    } else {
      evaluate<Order::ColumnMajor>(problem.observations, x, nullptr, jacobian);
    }
    return 0;
  }

  const ProblemSet& problems_;
  double tolerance_;
  std::vector<double> residuals_;
  std::vector<double> jacobian_;
  std::vector<double> work_;
};

std::unique_ptr<Peer> make_default(const ProblemSet& problems) {
  // The square root of the rounding error, as MINPACK's guide recommends.
  return std::make_unique<CminpackPeer>(problems, 1.5e-8);
}

std::unique_ptr<Peer> make_loose(const ProblemSet& problems) {
  return std::make_unique<CminpackPeer>(problems, step_tolerance_m);
}

}  // namespace

std::span<const PeerEntry> cminpack_peers() {
  static constexpr PeerEntry entries[] = {
      {"cminpack/default", make_default},
      {"cminpack/loose", make_loose},
  };
  return entries;
}

}  // namespace ridgeloc::bench
