
#include "core/problem.hpp"
#include "core/solution.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::core;

TEST_CASE("columns of a problem batch do not overlap and hold one value per trial") {
  ProblemBatch problems;
  problems.reshape(3, 5);
  problems.add_scores();
  double next = 0.0;
  const auto fill = [&next](std::span<double> column) {
    CHECK(column.size() == 5);
    for (double& value : column) value = next++;
  };
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t axis = 0; axis < 3; ++axis) fill(problems.position(j, axis));
    fill(problems.measured(j));
    fill(problems.score(j));
  }
  for (std::size_t axis = 0; axis < 3; ++axis) fill(problems.start(axis));
  CHECK(problems.position(0, 0)[0] == 0.0);
  CHECK(problems.score(2)[4] == 74.0);
  CHECK(problems.start(2)[4] == next - 1.0);
}

TEST_CASE("a reshaped problem batch forgets its scores") {
  ProblemBatch problems;
  problems.reshape(3, 5);
  problems.add_scores();
  problems.reshape(3, 5);
  CHECK_FALSE(problems.has_scores());
}

TEST_CASE("a solution starts as not run") {
  SolutionBatch solutions;
  solutions.reshape(2);
  CHECK(solutions.status[1] == static_cast<std::uint8_t>(Status::NotRun));
  CHECK(status_names[static_cast<std::size_t>(Status::LeftDomain)] == "left_domain");
}
