#include <ceres/cost_function.h>
#include <ceres/iteration_callback.h>
#include <ceres/problem.h>
#include <ceres/solver.h>

#include "bench/peer.hpp"
#include "bench/range_model.hpp"
#include "bench/stop.hpp"

namespace ridgeloc::bench {

namespace {

/// All ranges of one problem as one residual block with analytic derivatives. The observations are exchanged from
/// solve to solve, so that the ceres::Problem is built once.
class Ranges : public ceres::CostFunction {
 public:
  explicit Ranges(std::size_t points) {
    set_num_residuals(static_cast<int>(points));
    mutable_parameter_block_sizes()->push_back(3);
  }

  void look_at(std::span<const Observation> observations) { observations_ = observations; }

  bool Evaluate(double const* const* x, double* residuals, double** jacobians) const override {
    evaluate<Order::RowMajor>(observations_, x[0], residuals, jacobians == nullptr ? nullptr : jacobians[0]);
    return true;
  }

 private:
  std::span<const Observation> observations_;
};

/// Ends the solve when an accepted step is short. Ceres 2.2 reports a length of 0 for the first step, which a naive
/// test would take for convergence; 0 here means "not known".
class ShortStep : public ceres::IterationCallback {
 public:
  ceres::CallbackReturnType operator()(const ceres::IterationSummary& summary) override {
    const bool is_short = summary.step_norm > 0.0 && summary.step_norm < step_tolerance_m;
    return summary.step_is_successful && is_short ? ceres::SOLVER_TERMINATE_SUCCESSFULLY : ceres::SOLVER_CONTINUE;
  }
};

class CeresPeer : public Peer {
 public:
  CeresPeer(const ProblemSet& problems, ceres::LinearSolverType linear_solver, bool matched)
      : problems_(problems), ranges_(problems.points()), problem_(problem_options()) {
    problem_.AddResidualBlock(&ranges_, nullptr, x_.data());
    options_.linear_solver_type = linear_solver;
    options_.logging_type = ceres::SILENT;
    if (!matched) return;
    options_.max_num_iterations = max_steps;
    options_.function_tolerance = 0.0;
    options_.gradient_tolerance = 0.0;
    options_.parameter_tolerance = 0.0;
    options_.callbacks.push_back(&short_step_);
  }

  Answer solve(std::size_t trial) override {
    x_ = problems_.start(trial);
    ranges_.look_at(problems_.observations(trial));
    ceres::Solve(options_, &problem_, &summary_);
    const bool converged =
        summary_.termination_type == ceres::CONVERGENCE || summary_.termination_type == ceres::USER_SUCCESS;
    // The first entry is the evaluation at the start.
    return {x_, static_cast<double>(summary_.iterations.size()) - 1.0, converged};
  }

 private:
  static ceres::Problem::Options problem_options() {
    ceres::Problem::Options options;
    options.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
    options.disable_all_safety_checks = true;
    return options;
  }

  const ProblemSet& problems_;
  std::array<double, 3> x_{};
  Ranges ranges_;
  ShortStep short_step_;
  ceres::Problem problem_;
  ceres::Solver::Options options_;
  ceres::Solver::Summary summary_;
};

template <ceres::LinearSolverType linear_solver, bool matched>
std::unique_ptr<Peer> make(const ProblemSet& problems) {
  return std::make_unique<CeresPeer>(problems, linear_solver, matched);
}

}  // namespace

std::span<const PeerEntry> ceres_peers() {
  static constexpr PeerEntry entries[] = {
      {"ceres-qr/matched", make<ceres::DENSE_QR, true>},
      {"ceres-qr/default", make<ceres::DENSE_QR, false>},
      {"ceres-cholesky/matched", make<ceres::DENSE_NORMAL_CHOLESKY, true>},
  };
  return entries;
}

}  // namespace ridgeloc::bench
