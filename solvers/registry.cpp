#include <algorithm>
#include <array>

#include "solvers/k_registry.hpp"
#include "solvers/lm.hpp"
#include "solvers/ols.hpp"
#include "solvers/ridge.hpp"
#include "solvers/solver.hpp"

namespace ridgeloc::solvers {

namespace {

void solve_ols(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
               core::SolutionBatch& out) {
  solve_batch(Ols{}, problems, options, oracle, out);
}

void solve_lm(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
              core::SolutionBatch& out) {
  solve_batch(LazyLevenbergMarquardt{}, problems, options, oracle, out);
}

void solve_rr(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
              core::SolutionBatch& out) {
  solve_batch(Ridge{options, oracle, false}, problems, options, oracle, out);
}

void solve_rrr(const core::ProblemBatch& problems, const SolverOptions& options, const core::Oracle* oracle,
               core::SolutionBatch& out) {
  solve_batch(Ridge{options, oracle, true}, problems, options, oracle, out);
}

}  // namespace

std::span<const SolverEntry> solver_registry() {
  static const std::vector<std::string_view> ridge_options = {
      "k", "k_fixed", "similarity", "k_error", "k_error_draw", "ktrue", "eta"};
  static const std::vector<std::string_view> robust_options = [] {
    auto options = ridge_options;
    options.emplace_back("theta_m");
    return options;
  }();
  static const std::array<SolverEntry, 4> registry = {{
      {"ols", "Gauss-Newton least squares", {}, solve_ols},
      {"lm", "Levenberg-Marquardt, damped only after a rejected step", {}, solve_lm},
      {"rr", "ridge regression with K estimated at every iteration", ridge_options, solve_rr},
      {"rrr", "robust ridge regression: reweighted residuals and K", robust_options, solve_rrr},
  }};
  return registry;
}

const SolverEntry* find_solver(std::string_view name) {
  const auto registry = solver_registry();
  const auto found = std::ranges::find(registry, name, &SolverEntry::name);
  return found == registry.end() ? nullptr : &*found;
}

std::span<const KEstimatorEntry> k_estimator_registry() {
  static constexpr auto registry = []<std::size_t... I>(std::index_sequence<I...>) {
    return std::array{KEstimatorEntry{std::tuple_element_t<I, KEstimators>::name,
                                      std::tuple_element_t<I, KEstimators>::summary,
                                      std::tuple_element_t<I, KEstimators>::needs_oracle}...};
  }
  (std::make_index_sequence<std::tuple_size_v<KEstimators>>{});
  return registry;
}

std::optional<std::size_t> find_k_estimator(std::string_view name) {
  const auto registry = k_estimator_registry();
  const auto found = std::ranges::find(registry, name, &KEstimatorEntry::name);
  if (found == registry.end()) return std::nullopt;
  return static_cast<std::size_t>(found - registry.begin());
}

}  // namespace ridgeloc::solvers
