// How a photo ends, by how its starts end: problems in ranges whose solutions are known.

#include "studies/building/building_outcome.hpp"

#include <cmath>

#include "studies/building/building_trials.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/hall.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

using Place = std::array<double, 3>;

/// Adds a start of a photo. The places that it ranges to are `spread` metres from the middle of the hall: from one
/// point alone no position follows.
struct Hand {
  BuildingScratch scratch{core::Isa::Baseline};
  std::vector<Place> targets;
  std::vector<double> spreads;

  void add(std::uint32_t photo, Place target, double spread = 5.0) {
    scratch.starts.push_back({photo, {target[0] + 0.1, target[1] - 0.1}, 0, 4});
    targets.push_back(target);
    spreads.push_back(spread);
  }

  const std::vector<PhotoOutcome>& solve(std::vector<std::array<double, 2>> truths) {
    for (const auto& truth : truths) scratch.photos.emplace_back().truth_m = truth;
    static constexpr std::array<Place, 4> directions = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, 0.5}}};
    StartGroup& group = scratch.groups.emplace_back();
    const std::size_t n = scratch.starts.size();
    group.points = directions.size();
    group.problems.reshape(group.points, n);
    for (std::size_t axis = 0; axis < 3; ++axis) group.truth[axis].assign(n, 0.0);
    for (std::size_t t = 0; t < n; ++t) {
      group.starts.push_back(static_cast<std::uint32_t>(t));
      group.problems.start(0)[t] = scratch.starts[t].place_m[0];
      group.problems.start(1)[t] = scratch.starts[t].place_m[1];
      group.problems.start(2)[t] = targets[t][2] + 0.1;
      for (std::size_t j = 0; j < group.points; ++j) {
        double squares = 0.0;
        for (std::size_t axis = 0; axis < 3; ++axis) {
          const double at = spreads[t] * directions[j][axis];
          group.problems.position(j, axis)[t] = at;
          squares += (at - targets[t][axis]) * (at - targets[t][axis]);
        }
        group.problems.measured(j)[t] = std::sqrt(squares);
      }
    }
    solvers::SolverOptions options;
    options.step_tolerance_m = 1e-9;
    REQUIRE(locate(tests::hall({}), {"ols", "ols", {}}, options, NoMonitor(), scratch));
    return scratch.outcomes;
  }
};

}  // namespace

TEST_CASE("a photo is located if a start converges inside the map, at the mean over these") {
  Hand hand;
  hand.add(0, {1, 2, 1});
  hand.add(0, {3, 2, 1});
  hand.add(0, {30, 0, 1});      // outside
  hand.add(0, {2, 2, 1}, 0.0);  // singular
  const PhotoOutcome outcome = hand.solve({{2.0, 1.0}})[0];
  CHECK(outcome.status == PhotoStatus::Success);
  CHECK(outcome.starts == 4);
  CHECK(outcome.converged == 3);
  CHECK(outcome.inside == 2);
  CHECK(outcome.x_m == Approx(2.0));
  CHECK(outcome.y_m == Approx(2.0));
  CHECK(outcome.error_m == Approx(1.0));
  const auto& ends = hand.scratch.ends;
  CHECK(outcome.iterations == 0.5 * (ends[0].iterations + ends[1].iterations));
  CHECK(ends[3].status == core::Status::Singular);
}

TEST_CASE("a photo ends outside of the map, diverged or without a start") {
  Hand hand;
  hand.add(0, {30, 0, 1});
  hand.add(0, {2, 2, 1}, 0.0);
  hand.add(1, {2, 2, 1}, 0.0);
  hand.add(3, {1, 1, 1});
  const auto& outcomes = hand.solve({{0, 0}, {0, 0}, {0, 0}, {1, 1}});
  REQUIRE(outcomes.size() == 4);
  CHECK(outcomes[0].status == PhotoStatus::OutsideMap);
  CHECK(outcomes[0].converged == 1);
  CHECK(outcomes[1].status == PhotoStatus::Diverged);
  CHECK(outcomes[1].starts == 1);
  CHECK(outcomes[2].status == PhotoStatus::NoStart);
  CHECK(outcomes[2].starts == 0);
  CHECK(outcomes[3].status == PhotoStatus::Success);
  CHECK(outcomes[3].error_m < 1e-9);
}
