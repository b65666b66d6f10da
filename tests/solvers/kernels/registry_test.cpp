#include <string>

#include "core/error.hpp"
#include "core/problem.hpp"
#include "solvers/kernels/trace.hpp"
#include "solvers/solver.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;
using namespace ridgeloc::solvers;

TEST_CASE("solvers and K estimators are found by name") {
  for (const SolverEntry& entry : solver_registry()) CHECK(find_solver(entry.name) == &entry);
  CHECK(find_solver("olss") == nullptr);
  for (const SolverEntry& entry : solver_registry()) CHECK(&solver_named(entry.name) == &entry);
  for (const char* name : {"kibria_gm", "fixed", "oracle_elem", "oracle_gm"}) {
    REQUIRE(find_k_estimator(name).has_value());
    CHECK(k_estimator_registry()[*find_k_estimator(name)].name == name);
  }
  CHECK_FALSE(find_k_estimator("").has_value());
}

TEST_CASE("an unknown solver is one line that names those there are") {
  const std::string message = tests::refusal_of([] { solver_named("olss"); });
  CHECK(message.starts_with("there is no solver \"olss\"; one of: ols, lm, dogleg, "));
  CHECK(message.find('\n') == std::string::npos);
  CHECK_THROWS_AS(trace("olss", core::ProblemBatch(), 0, {}, nullptr), core::InputError);
}
