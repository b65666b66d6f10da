#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/stream.hpp"

namespace ridgeloc::core {

/// Unknowns of the range model: the position x, y, z in metres.
inline constexpr std::size_t position_parameters = 3;

/// What a solver may see: a batch of problems with the same number of points, one slot per trial.
///
/// The range model. Camera position x (m, unknown), points p_j (m, known), measured ranges
/// m_j = |p_j - x| + noise (m), detection scores s_j in [0, 1].
///
/// Structure of arrays: every accessor returns one quantity of all trials, contiguous, indexed by trial.
/// `reshape` allocates only when the batch grows. Not synchronized: one batch per thread.
class ProblemBatch {
 public:
  /// Most trials that a kernel may take at once.
  static constexpr std::size_t largest_lanes = 32;

  /// Makes room for `trials` problems of `points` points each; contents are unspecified afterwards, scores absent.
  void reshape(std::size_t points, std::size_t trials);

  std::size_t points() const { return points_; }
  std::size_t trials() const { return trials_; }

  /// Coordinate `axis` (0 = x, 1 = y, 2 = z) of point `point`, in metres.
  std::span<double> position(std::size_t point, std::size_t axis) { return column(position_column(point, axis)); }
  std::span<const double> position(std::size_t point, std::size_t axis) const {
    return column(position_column(point, axis));
  }

  /// Measured range to point `point`, in metres.
  std::span<double> measured(std::size_t point) { return column(measured_column(point)); }
  std::span<const double> measured(std::size_t point) const { return column(measured_column(point)); }

  /// Initial value of position coordinate `axis`, in metres.
  std::span<double> start(std::size_t axis) { return column(start_column(points_, axis)); }
  std::span<const double> start(std::size_t axis) const { return column(start_column(points_, axis)); }

  /// Detection scores. Without them every score is 1.
  bool has_scores() const { return has_scores_; }
  void add_scores();
  std::span<double> score(std::size_t point) { return column(score_column(points_, point)); }
  std::span<const double> score(std::size_t point) const { return column(score_column(points_, point)); }

  /// All columns, one every `stride()` numbers. Kernels may read `largest_lanes` numbers beyond the end of any of them.
  const double* data() const { return values_.data(); }
  std::size_t stride() const { return stride_; }
  std::size_t columns() const { return start_column(points_, 3) + (has_scores_ ? points_ : 0); }
  static std::size_t position_column(std::size_t point, std::size_t axis) { return point * 4 + axis; }
  static std::size_t measured_column(std::size_t point) { return point * 4 + 3; }
  static std::size_t start_column(std::size_t points, std::size_t axis) { return points * 4 + axis; }
  static std::size_t score_column(std::size_t points, std::size_t point) { return points * 4 + 3 + point; }

  /// Copies one problem of a batch with as many points, and scores if this one has them, into a slot of this one.
  void copy_trial(const ProblemBatch& from, std::size_t trial, std::size_t slot);

 private:
  std::span<double> column(std::size_t index) { return {values_.data() + index * stride_, trials_}; }
  std::span<const double> column(std::size_t index) const { return {values_.data() + index * stride_, trials_}; }

  std::size_t points_ = 0;
  std::size_t trials_ = 0;
  std::size_t stride_ = 0;
  bool has_scores_ = false;
  std::vector<double> values_;
};

/// What only a simulation knows. Solvers that are not oracles use it for one thing alone: to report how similar
/// their K is to the true one. Only `studies` and tests fill it.
struct Oracle {
  std::array<std::span<const double>, position_parameters> truth;  ///< true position (m), by trial
  double range_sigma_m = 0.0;                                      ///< true standard deviation of the noise
  Stream k_error;                                                  ///< directions of the error of a perturbed K
  std::uint64_t first_trial = 0;                                   ///< number of the trial in slot 0
};

}  // namespace ridgeloc::core
