#include <Eigen/Core>
#include <unsupported/Eigen/LevenbergMarquardt>

#include "bench/peer.hpp"
#include "bench/range_model.hpp"
#include "bench/stop.hpp"

namespace ridgeloc::bench {

namespace {

/// Of dynamic size, because Eigen's solver does not compile with any other.
struct Ranges : Eigen::DenseFunctor<double> {
  explicit Ranges(std::size_t points) : DenseFunctor(3, static_cast<int>(points)) {}

  int operator()(const Eigen::VectorXd& x, Eigen::VectorXd& residuals) const {
    evaluate<Order::ColumnMajor>(observations, x.data(), residuals.data(), nullptr);
    return 0;
  }
  int df(const Eigen::VectorXd& x, Eigen::MatrixXd& jacobian) const {
    evaluate<Order::ColumnMajor>(observations, x.data(), nullptr, jacobian.data());
    return 0;
  }

  std::span<const Observation> observations;
};

/// Eigen's port of MINPACK. Its tolerances are relative, as MINPACK's are, so that no value matches our stop rule.
class EigenPeer : public Peer {
 public:
  EigenPeer(const ProblemSet& problems, bool loose) : problems_(problems), ranges_(problems.points()) {
    if (!loose) return;
    solver_.setXtol(step_tolerance_m);
    solver_.setFtol(step_tolerance_m);
  }

  Answer solve(std::size_t trial) override {
    x_ = Eigen::Vector3d::Map(problems_.start(trial).data());
    ranges_.observations = problems_.observations(trial);
    const auto status = solver_.minimize(x_);
    // The last statuses say that the tolerance asked for is below rounding: there is no better estimate.
    const bool converged = status >= Eigen::LevenbergMarquardtSpace::RelativeReductionTooSmall &&
                           status <= Eigen::LevenbergMarquardtSpace::GtolTooSmall &&
                           status != Eigen::LevenbergMarquardtSpace::TooManyFunctionEvaluation;
    return {{x_[0], x_[1], x_[2]}, static_cast<double>(solver_.nfev()) - 1.0, converged};
  }

 private:
  const ProblemSet& problems_;
  Ranges ranges_;
  Eigen::LevenbergMarquardt<Ranges> solver_{ranges_};
  Eigen::VectorXd x_;
};

template <bool loose>
std::unique_ptr<Peer> make(const ProblemSet& problems) {
  return std::make_unique<EigenPeer>(problems, loose);
}

}  // namespace

std::span<const PeerEntry> eigen_peers() {
  static constexpr PeerEntry entries[] = {
      {"eigen-lm/default", make<false>},
      {"eigen-lm/loose", make<true>},
  };
  return entries;
}

}  // namespace ridgeloc::bench
