#include <ceres/tiny_solver.h>

#include <algorithm>

#include "bench/fixed_size.hpp"
#include "bench/range_model.hpp"
#include "bench/stop.hpp"

namespace ridgeloc::bench {

namespace {

template <int points>
struct Ranges {
  using Scalar = double;
  enum { NUM_RESIDUALS = points, NUM_PARAMETERS = 3 };  // NOLINT(readability-identifier-naming): its names

  bool operator()(const double* x, double* residuals, double* jacobian) const {
    evaluate<Order::ColumnMajor>({observations, points}, x, residuals, jacobian);
    return true;
  }

  const Observation* observations;
};

/// TinySolver stops when |dx| < tol (|x| + tol), an absolute rule only where |x| hardly varies. So the matched variant
/// solves the problems in a frame whose origin is this far away (m): with tol = step_tolerance_m / offset the rule is
/// |dx| < step_tolerance_m to 0.1 % within 10 m, and coordinates keep their digits to 2e-12 m.
constexpr double offset_m = 1e4;

template <int points, bool matched>
class TinySolverPeer : public Peer {
 public:
  explicit TinySolverPeer(const ProblemSet& problems) : problems_(matched ? problems.moved_by(offset) : problems) {
    if constexpr (matched) {
      // Its first iteration is number 1, and number max_num_iterations is not run.
      solver_.options.max_num_iterations = max_steps + 1;
      solver_.options.parameter_tolerance = step_tolerance_m / offset_m;
      solver_.options.function_tolerance = 0.0;
      solver_.options.gradient_tolerance = 0.0;
      solver_.options.cost_threshold = 0.0;
    }
  }

  Answer solve(std::size_t trial) override {
    Eigen::Vector3d x = Eigen::Vector3d::Map(problems_.start(trial).data());
    const auto& summary = solver_.Solve(Ranges<points>{problems_.observations(trial).data()}, &x);
    if constexpr (matched) x -= Eigen::Vector3d::Map(offset.data());
    const int steps = std::min(summary.iterations, solver_.options.max_num_iterations - 1);
    return {{x[0], x[1], x[2]}, static_cast<double>(steps), summary.status != Solver::HIT_MAX_ITERATIONS};
  }

 private:
  using Solver = ceres::TinySolver<Ranges<points>>;
  static constexpr std::array<double, 3> offset = {offset_m, 0.0, 0.0};

  const ProblemSet problems_;
  Solver solver_;
};

template <bool matched>
std::unique_ptr<Peer> make(const ProblemSet& problems) {
  return with_fixed_size(problems.points(), [&]<std::size_t points>() -> std::unique_ptr<Peer> {
    return std::make_unique<TinySolverPeer<static_cast<int>(points), matched>>(problems);
  });
}

}  // namespace

std::span<const PeerEntry> tiny_solver_peers() {
  static constexpr PeerEntry entries[] = {
      {"tinysolver/matched", make<true>},
      {"tinysolver/default", make<false>},
  };
  return entries;
}

}  // namespace ridgeloc::bench
