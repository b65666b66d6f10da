#pragma once

#include <array>
#include <string_view>
#include <tuple>
#include <type_traits>

#include "solvers/estimators/k_kernels.hpp"
#include "solvers/methods/ridge_weights.hpp"
#include "solvers/methods/step.hpp"
#include "solvers/models/kernel_size.hpp"
#include "solvers/models/least_squares.hpp"
#include "solvers/models/weight.hpp"
#include "solvers/objective.hpp"

namespace ridgeloc::solvers {

/// What kernels are made for.
enum class RidgeKind {
  Paper,    ///< the paper's estimator of K, options at their defaults
  Plain,    ///< any estimator, options at their defaults
  General,  ///< any estimator and all options
};

/// Ridge regression, and robust ridge regression where `robust` is set: dx = (J'WJ + K)^-1 J'We with K from `options.k`
/// at every iteration (RRR paper, eqs. 10, 12, 13, 14).
///
/// W is diag(s^2), or the robust weights of weight.hpp at x_k. An estimator of K that learns from the data gets one
/// least-squares step dx_ls at x_k, with W = diag(s^2) in either case, and sigma2 = e'We / n at x_k - dx_ls, what is
/// known of v among the n observations.
template <bool robust, RidgeKind kind>
struct RidgeMethod : MethodDefaults {
  static constexpr bool has_k = true;
  static constexpr bool plain = kind != RidgeKind::General;
  static constexpr KernelSize size = kind == RidgeKind::Paper   ? KernelSize::Unrolled
                                     : kind == RidgeKind::Plain ? KernelSize::Wide
                                                                : KernelSize::Small;

  const SolverOptions& options;

  explicit RidgeMethod(const SolverOptions& o) : options(o) {}

  template <class Model, class Vector>
  auto weights(const Model& model, const Vector& u) const {
    if constexpr (!robust) {
      return ScoreWeights(options);
    } else if constexpr (plain) {
      return PaperWeights(options, model.points(), Model::unknowns);
    } else {
      const bool elsewhere = options.irls_residual == IrlsResidual::Ols;
      const auto ols = elsewhere ? least_squares_at(model, u).ols_step : u;
      return RidgeWeights<Model>(options, model, u, ols);
    }
  }

  template <class Model, class Vector, class Real, class Oracle, class Memory>
  Step<Real, Model::unknowns> step(const Model& model, const Vector& u, const Real& iteration, const Oracle* oracle,
                                   Memory&) const {
    constexpr std::size_t P = Model::unknowns;
    const KTraits estimator = kind == RidgeKind::Paper ? traits_of<KibriaGm, Real>(options) : k_traits<Real>(options);
    const bool learns = estimator.needs_ols_step || (!plain && robust && options.irls_residual == IrlsResidual::Ols);

    NormalEquations<Real, P> equations;
    LeastSquares<Real, P> ols;
    if constexpr (robust && plain) {
      const PaperWeights paper(options, model.points(), P);
      if (learns) {
        observe_once(model, u, paper, equations, ols.equations);
        solve_least_squares(model, u, ols);
      } else {
        equations = normal_equations(model, u, paper);
      }
    } else {
      if (learns) ols = least_squares_at(model, u);
      if constexpr (robust) {
        const RidgeWeights<Model> own(options, model, u, ols.ols_step);
        equations = normal_equations(model, u, own);
      } else {
        equations = learns ? ols.equations : normal_equations(model, u, ScoreWeights(options));
      }
    }

    KContext<Real, P> context{ols.equations, ols.ols_step,         Real(0.0), Real(0.0), ols.ols_step, {}, u,
                              iteration,     model.observations(), oracle,    options};
    if (estimator.needs_ols_step) fill_variance(model, u, estimator, context);
    RidgeMatrix<Real, P> k;
    if constexpr (kind == RidgeKind::Paper) {
      k = core::add_diagonal(k, KibriaGm{}(context));
    } else {
      k_kernel<Real, P>(options.k)(context, k);
    }
    equations.matrix = core::add(equations.matrix, k);
    if (!plain && options.ridge_anchor == RidgeAnchor::Prior) {
      const Vector pull = core::multiply(k, core::subtract(u, model.start()));
      core::unroll<P>([&](auto i) { equations.gradient[i] = equations.gradient[i] + pull[i]; });
    }
    const auto solution = core::solve(equations.matrix, equations.gradient, model.observations());
    const core::Mask<Real> singular = ols.singular | solution.singular;
    return {solution.x, singular, !singular, core::diagonal(k)};
  }

 private:
  /// Both sets of equations in one pass, since observing is the most expensive part.
  template <class Model, class Vector, class Equations>
  void observe_once(const Model& model, const Vector& u, const PaperWeights& paper, Equations& weighted,
                    Equations& unweighted) const {
    const ScoreWeights scores(options);
    for_each_point(
        model,
        [](auto j, const Model& m, const auto& at, const auto& robustly, const auto& plainly, auto& a, auto& b)
            __attribute__((always_inline)) {
              const auto o = m.observe(j, at);
              const auto score = m.score(j);
              a.add(o, robustly(j, score, o.residual));
              b.add(o, plainly(j, score, o.residual));
            },
        u, paper, scores, weighted, unweighted);
    model.add_prior(u, paper.largest(), weighted);
    model.add_prior(u, 1.0, unweighted);
  }

  template <class Model, class Vector, class Real = typename Model::Real>
  LeastSquares<Real, Model::unknowns> least_squares_at(const Model& model, const Vector& u) const {
    LeastSquares<Real, Model::unknowns> ols;
    ols.equations = normal_equations(model, u, ScoreWeights(options));
    solve_least_squares(model, u, ols);
    return ols;
  }

  template <class Model, class Vector, class Real = typename Model::Real>
  void solve_least_squares(const Model& model, const Vector& u, LeastSquares<Real, Model::unknowns>& ols) const {
    const auto solution = core::solve(ols.equations.matrix, ols.equations.gradient, model.observations());
    ols.ols_step = solution.x;
    ols.singular = solution.singular;
    if (!plain && options.ols_mode == OlsMode::Full) ols.ols_step = full_least_squares(options, model, u, ols);
  }

  /// What is known of v is one of the n observations, and its weighted squared residual one of the squares, in every
  /// sigma2.
  template <class Model, class Vector, class Real, std::size_t P>
  void fill_variance(const Model& model, const Vector& u, const KTraits& estimator, KContext<Real, P>& c) const {
    const ScoreWeights scores(options);
    const auto squares_at = [&](const Vector& at) {
      return weighted_squares(model, at, scores) + model.prior_squares(at);
    };
    const auto n = static_cast<double>(c.observations);
    const bool by_dof = !plain && options.sigma2_source == Sigma2Source::Dof;
    if (estimator.needs_squares || by_dof) c.squares = squares_at(u);
    if (by_dof) {
      // At the end of Gauss-Newton the linearised problem has nothing left to fit.
      const Real rest = options.ols_mode == OlsMode::Full
                            ? squares_at(core::subtract(u, c.ols_step))
                            : core::max(c.squares - core::dot(c.least_squares.gradient, c.ols_step), Real(0.0));
      c.sigma2 = rest * core::reciprocal(Real(n - static_cast<double>(P)));
    } else if (!plain && options.sigma2_source == Sigma2Source::Prior) {
      c.sigma2 = Real(options.sigma_prior_m * options.sigma_prior_m);
    } else {
      c.sigma2 = squares_at(core::subtract(u, c.ols_step)) * Real(1.0 / n);
    }
  }
};

/// Ridge regression, or robust ridge regression.
template <bool robust>
struct Ridge : SolverDefaults {
  /// Where the iteration rests it is a minimum of squares, but K may bring it to the stop rule long before.
  static constexpr bool is_least_squares = false;
  static constexpr Objective anchored = Objective::none("pulls to the start: biased on purpose");

  using Specialized = std::tuple<RidgeMethod<robust, RidgeKind::Paper>, RidgeMethod<robust, RidgeKind::Plain>,
                                 RidgeMethod<robust, RidgeKind::General>>;
  using Variants =
      std::conditional_t<has_specialized_kernels, Specialized, std::tuple<RidgeMethod<robust, RidgeKind::General>>>;
  static std::size_t variant(const SolverOptions& o) {
    if (!has_specialized_kernels) return 0;
    const bool plain = o.normalize_weights == NormalizeWeights::Off && o.irls_residual == IrlsResidual::Current &&
                       o.ols_mode == OlsMode::Step && o.ridge_anchor == RidgeAnchor::Current &&
                       o.sigma2_source == Sigma2Source::NonlinearMs;
    const RidgeKind kind = !plain ? RidgeKind::General : uses_paper_k(o) ? RidgeKind::Paper : RidgeKind::Plain;
    return static_cast<std::size_t>(kind);
  }
};

struct RidgeRegression : Ridge<false> {
  static constexpr std::string_view name = "rr";
  static constexpr std::string_view summary = "ridge regression with K estimated at every iteration";
  static constexpr std::array<std::string_view, 12> option_names = {
      "k",     "k_fixed", "k_expr",   "similarity",    "k_error",      "k_error_draw",
      "ktrue", "eta",     "ols_mode", "sigma2_source", "ridge_coords", "ridge_anchor"};
  static Objective objective(const SolverOptions& o) {
    return o.ridge_anchor == RidgeAnchor::Prior ? anchored : Objective(ReferenceLoss::WeightedSquares);
  }
};

struct RobustRidgeRegression : Ridge<true> {
  static constexpr std::string_view name = "rrr";
  static constexpr std::string_view summary = "robust ridge regression: reweighted residuals and K";
  static constexpr std::array<std::string_view, 16> option_names = {
      "k",       "k_fixed",    "k_expr",        "similarity",       "k_error",      "k_error_draw",
      "ktrue",   "eta",        "ols_mode",      "sigma2_source",    "ridge_coords", "ridge_anchor",
      "theta_m", "irls_min_n", "irls_residual", "normalize_weights"};
  static Objective objective(const SolverOptions& o) {
    if (o.ridge_anchor == RidgeAnchor::Prior) return anchored;
    if (o.normalize_weights == NormalizeWeights::On && o.v_mode == VMode::Prior)
      return Objective::none("weighs residuals and the prior against each other anew at every iterate");
    const Objective huber = ReferenceLoss::HuberTheta;
    return o.irls_residual == IrlsResidual::Current ? huber : huber.not_binding();
  }
};

}  // namespace ridgeloc::solvers
