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
/// Camera position x (m, unknown), points p_j (m, known), detection scores s_j in [0, 1]. Either ranges
/// m_j = |p_j - x| + noise (m) are measured, or `has_images()` and each point gives a pseudorange rho_j (m^2) and a
/// factor alpha_j (m^2 / mm^2) such that |p_j - x|^2 = alpha_j v^2 + rho_j up to noise, where v (mm, unknown) is the
/// image distance of the camera (RRR paper, eqs. 1, 2).
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

  /// Measured range to point `point` (m), or its pseudorange rho (m^2).
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

  /// Factors alpha_j (m^2 / mm^2), and initial values of the image distance v (mm). Scores must be added first.
  bool has_images() const { return has_images_; }
  void add_images();
  std::span<double> alpha(std::size_t point) { return column(alpha_column(point)); }
  std::span<const double> alpha(std::size_t point) const { return column(alpha_column(point)); }
  std::span<double> start_image_distance() { return column(alpha_column(points_)); }
  std::span<const double> start_image_distance() const { return column(alpha_column(points_)); }

  /// All columns, one every `stride()` numbers. Kernels may read `largest_lanes` numbers beyond the end of any of them.
  const double* data() const { return values_.data(); }
  std::size_t stride() const { return stride_; }
  std::size_t columns() const { return alpha_column(has_images_ ? points_ + 1 : 0); }
  static std::size_t position_column(std::size_t point, std::size_t axis) { return point * 4 + axis; }
  static std::size_t measured_column(std::size_t point) { return point * 4 + 3; }
  static std::size_t start_column(std::size_t points, std::size_t axis) { return points * 4 + axis; }
  static std::size_t score_column(std::size_t points, std::size_t point) { return points * 4 + 3 + point; }
  std::size_t alpha_column(std::size_t point) const {
    return score_column(points_, (has_scores_ ? points_ : 0) + point);
  }

  /// Copies one problem of a batch with the same columns into a slot of this one.
  void copy_trial(const ProblemBatch& from, std::size_t trial, std::size_t slot);

 private:
  std::span<double> column(std::size_t index) { return {values_.data() + index * stride_, trials_}; }
  std::span<const double> column(std::size_t index) const { return {values_.data() + index * stride_, trials_}; }
  void grow();

  std::size_t points_ = 0;
  std::size_t trials_ = 0;
  std::size_t stride_ = 0;
  bool has_scores_ = false;
  bool has_images_ = false;
  std::vector<double> values_;
};

/// What only a simulation knows. Solvers that are not oracles use it for one thing alone: to report how similar
/// their K is to the true one. Only `studies` and tests fill it.
struct Oracle {
  std::array<std::span<const double>, position_parameters> truth;  ///< true position (m), by trial
  std::span<const double> image_distance;                          ///< true image distance (mm), where there are images
  double range_sigma_m = 0.0;                                      ///< true standard deviation of the noise
  Stream k_error;                                                  ///< directions of the error of a perturbed K
  std::uint64_t first_trial = 0;                                   ///< number of the trial in slot 0
};

}  // namespace ridgeloc::core
