// What solvers say of themselves.

#include "solvers/methods/declaration.hpp"

#include <algorithm>
#include <map>
#include <string_view>

#include "solvers/methods/methods.hpp"
#include "solvers/solver.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::solvers;

namespace {

struct Silent : SingleVariant<GaussNewton> {};

struct WithoutClaim : Silent {
  static constexpr std::string_view name = "without_claim";
  static constexpr std::string_view summary = "says nothing of its estimates";
  static constexpr std::array<std::string_view, 0> option_names{};
};

struct Vague : WithoutClaim {
  static bool is_least_squares() { return true; }
  static bool objective(const SolverOptions&) { return true; }
};

struct WithoutK : SingleVariant<GaussNewton> {
  static constexpr std::array<std::string_view, 2> option_names = {"k_fixed", "k"};
};

struct Expected {
  bool has_k;
  bool is_least_squares;
  std::optional<ReferenceLoss> loss;
};

}  // namespace

// No default says anything in place of the class.
static_assert(!SaysItsName<Silent> && !SaysObjective<Silent> && !SaysIfLeastSquares<Silent>);
static_assert(SaysItsName<WithoutClaim> && !SaysObjective<WithoutClaim> && !SaysIfLeastSquares<WithoutClaim>);
static_assert(!SaysObjective<Vague> && !SaysIfLeastSquares<Vague>);
static_assert(SaysObjective<Ols> && SaysIfLeastSquares<Ols> && SaysObjective<Linear> && SaysIfLeastSquares<Linear>);
static_assert(HasK<RidgeRegression> && !HasK<Ols> && !HasK<LevenbergMarquardt>);
static_assert(reads_option<WithoutK>("k") && !HasK<WithoutK> && !reads_option<Ols>("k"));

TEST_CASE("solvers say whether they have a K, are least squares, and what they minimise") {
  const std::map<std::string_view, Expected> expected = {
      {"ols", {false, true, ReferenceLoss::WeightedSquares}},
      {"lm", {false, true, ReferenceLoss::WeightedSquares}},
      {"dogleg", {false, true, ReferenceLoss::WeightedSquares}},
      {"rr", {true, false, ReferenceLoss::WeightedSquares}},
      {"rrr", {true, false, ReferenceLoss::HuberTheta}},
      {"irls", {false, false, ReferenceLoss::Reweighted}},
      {"gn_prior", {false, false, ReferenceLoss::WeightedSquares}},
      {"linear", {false, false, {}}},
      {"bancroft", {false, false, {}}},
  };
  for (const auto& [name, claims] : expected) {
    CAPTURE(name);
    const SolverEntry& entry = solver_named(name);
    CHECK(entry.has_k == claims.has_k);
    CHECK(entry.is_least_squares == claims.is_least_squares);
    CHECK(entry.objective({}).loss() == claims.loss);
    CHECK(entry.objective({}).is_binding());
  }
}

TEST_CASE("what solvers say of themselves fits together") {
  for (const SolverEntry& entry : solver_registry()) {
    CAPTURE(entry.name);
    const Objective objective = entry.objective({});
    CHECK(objective.why_none().empty() == objective.loss().has_value());
    if (entry.is_least_squares) CHECK(objective.loss() == ReferenceLoss::WeightedSquares);
    if (std::ranges::find(entry.options, "k") != entry.options.end()) CHECK(entry.has_k);
  }
}

TEST_CASE("what a solver minimises depends on its options") {
  SolverOptions anchored;
  anchored.ridge_anchor = RidgeAnchor::Prior;
  for (const char* name : {"rr", "rrr"}) CHECK_FALSE(solver_named(name).objective(anchored).why_none().empty());
  CHECK(solver_named("ols").objective(anchored).loss() == ReferenceLoss::WeightedSquares);
  SolverOptions elsewhere;
  elsewhere.irls_residual = IrlsResidual::Ols;
  CHECK_FALSE(solver_named("rrr").objective(elsewhere).is_binding());
  CHECK(solver_named("rr").objective(elsewhere).is_binding());
}
