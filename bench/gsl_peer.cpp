#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>

#include <cmath>

#include "bench/peer.hpp"
#include "bench/range_model.hpp"
#include "bench/stop.hpp"

namespace ridgeloc::bench {

namespace {

/// GSL's trust region method, stopped by our rule in a loop of our own around its iterations.
/// The vectors and the matrix that GSL passes are its workspace's own, contiguous by construction.
class GslPeer : public Peer {
 public:
  GslPeer(const ProblemSet& problems, const gsl_multifit_nlinear_solver* linear_solver) : problems_(problems) {
    // Without this GSL ends the program when one trial makes no progress.
    gsl_set_error_handler_off();
    auto parameters = gsl_multifit_nlinear_default_parameters();
    parameters.solver = linear_solver;
    workspace_.reset(gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, problems.points(), 3));
    function_.f = residuals;
    function_.df = jacobian;
    function_.n = problems.points();
    function_.p = 3;
    function_.params = &observations_;
  }

  Answer solve(std::size_t trial) override {
    observations_ = problems_.observations(trial);
    const auto start = gsl_vector_const_view_array(problems_.start(trial).data(), 3);
    bool going = gsl_multifit_nlinear_init(&start.vector, &function_, workspace_.get()) == GSL_SUCCESS;
    bool converged = false;
    while (going && !converged && steps() < max_steps) {
      going = gsl_multifit_nlinear_iterate(workspace_.get()) == GSL_SUCCESS;
      const double* dx = workspace_->dx->data;
      const double length2 = dx[0] * dx[0] + dx[1] * dx[1] + dx[2] * dx[2];
      converged = going && length2 < step_tolerance_m * step_tolerance_m;
    }
    const double* x = workspace_->x->data;
    return {{x[0], x[1], x[2]}, static_cast<double>(steps()), converged};
  }

 private:
  using Workspace = std::unique_ptr<gsl_multifit_nlinear_workspace, void (*)(gsl_multifit_nlinear_workspace*)>;

  /// One evaluation at the start, then one per step: an iteration of GSL may try several.
  int steps() const { return static_cast<int>(function_.nevalf) - 1; }

  static int residuals(const gsl_vector* x, void* data, gsl_vector* out) {
    const auto& observations = *static_cast<const std::span<const Observation>*>(data);
    evaluate<Order::RowMajor>(observations, x->data, out->data, nullptr);
    return GSL_SUCCESS;
  }

  static int jacobian(const gsl_vector* x, void* data, gsl_matrix* out) {
    const auto& observations = *static_cast<const std::span<const Observation>*>(data);
    evaluate<Order::RowMajor>(observations, x->data, nullptr, out->data);
    return GSL_SUCCESS;
  }

  const ProblemSet& problems_;
  std::span<const Observation> observations_;
  gsl_multifit_nlinear_fdf function_{};
  Workspace workspace_{nullptr, gsl_multifit_nlinear_free};
};

std::unique_ptr<Peer> make_cholesky(const ProblemSet& problems) {
  return std::make_unique<GslPeer>(problems, gsl_multifit_nlinear_solver_cholesky);
}

std::unique_ptr<Peer> make_qr(const ProblemSet& problems) {
  return std::make_unique<GslPeer>(problems, gsl_multifit_nlinear_solver_qr);
}

}  // namespace

std::span<const PeerEntry> gsl_peers() {
  static constexpr PeerEntry entries[] = {
      {"gsl-cholesky/matched", make_cholesky},
      {"gsl-qr/matched", make_qr},
  };
  return entries;
}

}  // namespace ridgeloc::bench
