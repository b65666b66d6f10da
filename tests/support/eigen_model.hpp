#pragma once

#include <Eigen/Dense>
#include <cstddef>

#include "solvers/options.hpp"
#include "tests/support/sample.hpp"

namespace ridgeloc::tests {

using Matrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Column = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

/// The models once more, written out with Eigen in long double, in unknowns of metres and millimetres that are then
/// scaled by hand: what the solvers are held against.
class EigenModel {
 public:
  EigenModel(const Sample& sample, const solvers::SolverOptions& options);

  long unknowns() const { return scale_.size(); }
  long points() const { return static_cast<long>(sample_.points.size()); }
  Column start() const { return start_; }  ///< scaled, as all vectors of unknowns here

  Column residual(const Column& u) const;
  Matrix rows(const Column& u) const;  ///< of the Jacobian
  Column score_weights() const;        ///< s^2

  /// The prior on v as a weighted row beside those of the points; none where the options have none.
  bool has_prior() const;
  Matrix weighted_rows(const Column& u) const;    ///< sqrt(W) J, the prior's row last
  Column weighted_errors(const Column& u) const;  ///< sqrt(W) e

  /// Position in metres; |step of the position|.
  Point position(const Column& u) const;
  long double move(const Column& du) const;

 private:
  Column metric(const Column& u) const;  ///< x, y, z, v

  Sample sample_;
  solvers::SolverOptions options_;
  long positions_ = 3;
  bool free_distance_ = false;
  Column scale_;
  Column start_;
};

}  // namespace ridgeloc::tests
