#pragma once

#include <array>
#include <cstddef>
#include <string_view>

namespace ridgeloc::solvers {

/// Which reading of the true ridge parameter K' at iterate x_k is meant, k'_i = sigma^2 / (x_k - x_true)_i^2.
enum class KTrue {
  Elem,  ///< each component its own (RRR paper, eq. 11)
  Gm,    ///< the geometric mean of the three for all (eq. 12 with true values)
};
inline constexpr std::array<std::string_view, 2> k_true_names = {"elem", "gm"};

/// Distance of two ridge parameters in the similarity eta = 1 / (1 + distance) (RRR paper, eq. 15).
enum class Eta {
  Squared,   ///< sqrt(sum (K_i - K'_i)^2)
  Absolute,  ///< sqrt(|sum (K_i - K'_i)|): the print, made safe against a negative sum
};
inline constexpr std::array<std::string_view, 2> eta_names = {"squared", "absolute"};

/// Direction of the error that is added to a true K to bring it down to a given similarity.
enum class KError {
  Signed,    ///< uniform on the sphere: components of either sign
  Positive,  ///< the same with every component made positive
};
inline constexpr std::array<std::string_view, 2> k_error_names = {"signed", "positive"};

/// How often that direction is drawn.
enum class KErrorDraw { PerIteration, PerTrial };
inline constexpr std::array<std::string_view, 2> k_error_draw_names = {"per_iteration", "per_trial"};

/// Settings of every solver, equal for all trials of a batch. A solver reads those that concern it.
struct SolverOptions {
  int max_iterations = 30;         ///< steps, the last one included; more is "max_iterations"
  double step_tolerance_m = 0.05;  ///< stop when |dx| < this
  double theta_m = 0.05;           ///< rrr: w_i = s_i / max(theta, |e_i|)
  std::size_t k = 0;               ///< rr, rrr: index into `k_estimator_registry()`
  double k_fixed = 0.0;            ///< the constant of the estimator "fixed"
  double similarity = 1.0;         ///< oracle estimators: eta of the K used against K'; 1 is K' itself
  KError k_error = KError::Signed;
  KErrorDraw k_error_draw = KErrorDraw::PerIteration;
  KTrue k_true = KTrue::Elem;  ///< the K' that the reported similarity refers to
  Eta eta = Eta::Squared;
};

}  // namespace ridgeloc::solvers
