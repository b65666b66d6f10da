#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "solvers/k_formula.hpp"

namespace ridgeloc::solvers {

/// Every choice is an enumeration and the names of its values in study files, in the same order.

/// What is known of the image distance v where points give pseudoranges.
enum class VMode {
  Free,   ///< nothing: v is an unknown like the position
  Fixed,  ///< v is the start's
  Prior,  ///< v is the start's within 0.5 % (one standard deviation)
};
inline constexpr std::array<std::string_view, 3> v_mode_names = {"free", "fixed", "prior"};

/// Whether the height z is an unknown or known to be the start's (pseudoranges only).
enum class ZMode { Free, Fixed };
inline constexpr std::array<std::string_view, 2> z_mode_names = {"free", "fixed"};

/// Scaling of the unknowns of pseudoranges: K is formed in scaled unknowns.
enum class ColumnScale {
  Norms,  ///< columns of J have norm 1 at the start
  None,
};
inline constexpr std::array<std::string_view, 2> column_scale_names = {"norms", "none"};

/// Residual of a pseudorange.
enum class Residual {
  Range,     ///< |p - x| - sqrt(alpha v^2 + rho)
  Quotient,  ///< (|p - x|^2 - alpha v^2 - rho) / (2 |p - x|); rows as if |p - x| below the line did not depend on x
};
inline constexpr std::array<std::string_view, 2> residual_names = {"range", "quotient"};

/// Rows of the Jacobian.
enum class Jacobian {
  Exact,
  Printed,  ///< RRR paper, eq. 6: (p - x) / |p - x|, 2 alpha v / |p - x| with residuals in m^2
};
inline constexpr std::array<std::string_view, 2> jacobian_names = {"exact", "printed"};

/// Where the iteration begins. A closed form that has no solution for a trial leaves it at the given start.
enum class Start { Given, Linear, Bancroft };
inline constexpr std::array<std::string_view, 3> start_names = {"given", "linear", "bancroft"};

/// How lm changes its damping.
enum class LmVariant {
  Lazy,       ///< none until a step is rejected
  Marquardt,  ///< always some
  More,       ///< MINPACK's trust region
};
inline constexpr std::array<std::string_view, 3> lm_variant_names = {"lazy", "marquardt", "more"};

/// Residuals that the robust weights of rrr are made from.
enum class IrlsResidual {
  Current,  ///< at x_k
  Ols,      ///< at x_k - dx_ls, after the least-squares step
};
inline constexpr std::array<std::string_view, 2> irls_residual_names = {"current", "ols"};

/// Scale of the standardized residuals of irls.
enum class Scale {
  Mad,    ///< 1.4826 median |e_i|, anew at every iterate
  Fixed,  ///< a constant
};
inline constexpr std::array<std::string_view, 2> scale_names = {"mad", "fixed"};

/// The variance that estimators of K use.
enum class Sigma2Source {
  NonlinearMs,  ///< e'We / n at x_k - dx_ls
  Dof,          ///< residual sum of squares of the linearised problem over n - p
  Prior,        ///< a constant
};
inline constexpr std::array<std::string_view, 3> sigma2_source_names = {"nonlinear_ms", "dof", "prior"};

/// Coordinates that estimators of K see dx_ls in.
enum class RidgeCoordinates {
  Raw,        ///< the unknowns themselves
  Canonical,  ///< along the eigenvectors of J'WJ
};
inline constexpr std::array<std::string_view, 2> ridge_coordinates_names = {"raw", "canonical"};

/// What the ridge pulls towards.
enum class RidgeAnchor {
  Current,  ///< the iterate: dx = (J'WJ + K)^-1 J'We
  Prior,    ///< the given start: dx = (J'WJ + K)^-1 (J'We + K (x_k - x_start))
};
inline constexpr std::array<std::string_view, 2> ridge_anchor_names = {"current", "prior"};

/// What dx_ls is.
enum class OlsMode {
  Step,  ///< one Gauss-Newton step at x_k
  Full,  ///< Gauss-Newton from x_k to its end
};
inline constexpr std::array<std::string_view, 2> ols_mode_names = {"step", "full"};

/// Power of the score in the weights.
enum class ScorePower {
  Printed,  ///< 2 in least squares, 1 in the robust weights of rrr (RRR paper, eqs. 7, 14)
  One,
  Two,
};
inline constexpr std::array<std::string_view, 3> score_power_names = {"printed", "1", "2"};

enum class NormalizeWeights { Off, On };
inline constexpr std::array<std::string_view, 2> normalize_weights_names = {"off", "on"};

/// Which reading of the true ridge parameter K' at iterate x_k is meant, k'_i = sigma^2 / (x_k - x_true)_i^2.
enum class KTrue {
  Elem,  ///< each component its own (RRR paper, eq. 11)
  Gm,    ///< the geometric mean of them for all (eq. 12 with true values)
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
  int max_iterations = 30;         ///< steps, the last one included; more is "iteration_limit"
  double step_tolerance_m = 0.05;  ///< stop when the position moves less than this
  Start start = Start::Given;
  ScorePower score_power = ScorePower::Printed;
  Jacobian jacobian = Jacobian::Exact;
  double sigma_prior_m = 0.1;  ///< standard deviation of a range that is taken as known, where one is

  // Pseudoranges.
  VMode v_mode = VMode::Free;
  ZMode z_mode = ZMode::Free;
  ColumnScale column_scale = ColumnScale::Norms;
  Residual residual = Residual::Range;

  LmVariant lm_variant = LmVariant::Lazy;
  double trust_radius_m = 10.0;  ///< dogleg: longest first step, in the unknowns (pseudoranges: scaled)

  std::size_t weight = 0;  ///< irls: index into `weight_registry()`
  double tuning = 0.0;     ///< irls: tuning constant of the weight; 0 is the weight's own
  Scale scale = Scale::Mad;
  double scale_m = 0.1;  ///< irls: the constant of Scale::Fixed

  double theta_m = 0.05;  ///< rrr: w_i = s_i / max(theta, |e_i|)
  IrlsResidual irls_residual = IrlsResidual::Current;
  int irls_min_n = 0;  ///< rrr: robust weights from this number of points on; 0 is more points than unknowns
  NormalizeWeights normalize_weights = NormalizeWeights::Off;  ///< rrr: scale the weights to a mean of 1

  std::size_t k = 0;     ///< rr, rrr: index into `k_estimator_registry()`
  double k_fixed = 0.0;  ///< the constant of the estimator "fixed"
  KFormula k_formula;    ///< the formula of the estimator "expr"
  Sigma2Source sigma2_source = Sigma2Source::NonlinearMs;
  RidgeCoordinates ridge_coordinates = RidgeCoordinates::Raw;
  RidgeAnchor ridge_anchor = RidgeAnchor::Current;
  OlsMode ols_mode = OlsMode::Step;
  double similarity = 1.0;  ///< oracle estimators: eta of the K used against K'; 1 is K' itself
  KError k_error = KError::Signed;
  KErrorDraw k_error_draw = KErrorDraw::PerIteration;
  KTrue k_true = KTrue::Elem;  ///< the K' that the reported similarity refers to
  Eta eta = Eta::Squared;
};

}  // namespace ridgeloc::solvers
