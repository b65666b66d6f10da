#include "solvers/solver.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::solvers;

TEST_CASE("solvers and K estimators are found by name") {
  for (const SolverEntry& entry : solver_registry()) CHECK(find_solver(entry.name) == &entry);
  CHECK(find_solver("olss") == nullptr);
  for (const char* name : {"kibria_gm", "fixed", "oracle_elem", "oracle_gm"}) {
    REQUIRE(find_k_estimator(name).has_value());
    CHECK(k_estimator_registry()[*find_k_estimator(name)].name == name);
  }
  CHECK_FALSE(find_k_estimator("").has_value());
}
