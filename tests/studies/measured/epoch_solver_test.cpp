#include "studies/measured/epoch_solver.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;
using studies::Epoch;
using studies::Place;

namespace {

const std::string exact_solvers = R"--(experiment = "ranging"
[solver]
step_tolerance_m = 1e-9
max_iterations = 300
start = "linear"
[[method]]
solver = "ols"
[[method]]
solver = "lm"
)--";

studies::Study study_of(const std::string& text) {
  return studies::read_study({"methods", "methods.toml", text});
}

/// Exact ranges from a place to objects, which are moved with it.
Epoch epoch_from(const Place& camera, const std::vector<Place>& objects, const Place& moved = {0, 0, 0}) {
  Epoch epoch;
  for (const Place& at : objects) {
    epoch.readings.push_back({"",
                              {at[0] + moved[0], at[1] + moved[1], at[2] + moved[2]},
                              std::hypot(camera[0] - at[0], camera[1] - at[1], camera[2] - at[2]),
                              1.0});
  }
  return epoch;
}

std::vector<std::vector<studies::Fix>> solve(studies::EpochSolver& solver, const std::vector<Epoch>& epochs) {
  std::vector<studies::EpochGeometry> geometries;
  for (const Epoch& epoch : epochs) geometries.push_back(studies::geometry_of_epoch(epoch, solver.knows_height()));
  return solver.solve(epochs, geometries);
}

double distance(const Place& a, const Place& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

const std::vector<Place> room = {{0, 0, 2.5}, {8, 0, 2}, {8, 6, 0.5}, {0, 6, 1}, {4, 3, 3}};
const Place camera = {2.0, 1.5, 1.0};

}  // namespace

TEST_CASE("exact ranges give the position, near the origin and in coordinates of a map projection") {
  studies::EpochSolver solver(study_of(exact_solvers), {}, core::best_isa());
  const Place map_origin = {500'000.0, 5'000'000.0, 300.0};
  const std::vector<Epoch> epochs = {epoch_from(camera, room), epoch_from(camera, {room.begin() + 1, room.end()}),
                                     epoch_from(camera, room, map_origin)};
  const auto fixes = solve(solver, epochs);
  REQUIRE(fixes.size() == 2);
  for (std::size_t m = 0; m < 2; ++m) {
    for (const studies::Fix& fix : fixes[m]) REQUIRE(fix.status == "converged");
    CHECK(distance(*fixes[m][0].position, camera) < 1e-9);
    CHECK(distance(*fixes[m][1].position, camera) < 1e-9);
    // Doubles at 5e6 are 1e-9 apart.
    const Place& far = *fixes[m][2].position;
    CHECK(distance({far[0] - map_origin[0], far[1] - map_origin[1], far[2] - map_origin[2]}, camera) < 3e-9);
    CHECK(fixes[m][2].residual_rms_m < 1e-9);
  }
}

TEST_CASE("an epoch's answer does not depend on the epochs beside it") {
  studies::EpochSolver solver(study_of(exact_solvers), {}, core::best_isa());
  std::vector<Epoch> epochs;
  for (int i = 0; i < 40; ++i) {
    epochs.push_back(epoch_from({0.1 * i, 1.5, 1.0}, {room.begin(), room.begin() + 3 + i % 3}));
    epochs.back().readings[0].range_m += 0.01 * (i % 7);
  }
  const auto together = solve(solver, epochs);
  for (std::size_t e = 0; e < epochs.size(); ++e) {
    const auto alone = solve(solver, {epochs[e]});
    CHECK(alone[0][0].position == together[0][e].position);
    CHECK(alone[0][0].status == together[0][e].status);
  }
}

TEST_CASE("of two mirror images the start decides which is found") {
  const std::vector<Place> ceiling = {{0, 0, 3}, {8, 0, 3}, {8, 6, 3}, {0, 6, 3}};
  const auto study = study_of(exact_solvers);
  studies::EpochSolver above(study, {}, core::best_isa());
  studies::EpochSolver below(study, {Place{4, 3, 0}, {}}, core::best_isa());
  const std::vector<Epoch> epochs = {epoch_from({2, 1.5, 1}, ceiling)};
  CHECK(distance(*solve(above, epochs)[1][0].position, {2, 1.5, 5}) < 1e-6);
  CHECK(distance(*solve(below, epochs)[1][0].position, {2, 1.5, 1}) < 1e-6);
}

TEST_CASE("with a known height two objects are enough, and the height is that of the start") {
  const std::string at_height = exact_solvers + "[scene]\nz_mode = \"fixed\"\n";
  studies::EpochSolver solver(study_of(at_height), {Place{1, 1, camera[2]}, {}}, core::best_isa());
  const auto fixes = solve(solver, {epoch_from(camera, room), epoch_from(camera, {room.begin(), room.begin() + 2})});
  CHECK(distance(*fixes[1][0].position, camera) < 1e-6);
  CHECK(distance(*fixes[1][1].position, camera) < 1e-6);
}

TEST_CASE("a covariance is given where no step is left, and nowhere else") {
  Epoch noisy = epoch_from(camera, room);
  for (std::size_t j = 0; j < room.size(); ++j) noisy.readings[j].range_m += j % 2 == 0 ? 0.05 : -0.05;
  const auto solved = [&](const std::string& methods) {
    studies::EpochSolver solver(study_of("experiment = \"ranging\"\n[solver]\nstep_tolerance_m = 1e-3\n" + methods), {},
                                core::best_isa());
    return solve(solver, {noisy})[0][0];
  };
  const studies::Fix at_rest = solved("[[method]]\nsolver = \"lm\"\n");
  CHECK(at_rest.is_settled);
  CHECK(at_rest.uncertainty.covariance);
  // A large K takes short steps far from the minimum.
  const studies::Fix damped = solved("k_fixed = 1e9\n[[method]]\nsolver = \"rr\"\nk = \"fixed\"\n");
  REQUIRE(damped.status == "converged");
  CHECK(!damped.is_settled);
  CHECK(!damped.uncertainty.covariance);
}

TEST_CASE("an epoch with too few objects has no position, and those beside it have theirs") {
  studies::EpochSolver solver(study_of(exact_solvers), {}, core::best_isa());
  const auto fixes =
      solve(solver, {epoch_from(camera, {room.begin(), room.begin() + 2}), epoch_from(camera, room), {}});
  CHECK(fixes[0][0].status == "too_few_objects");
  CHECK(!fixes[0][0].position);
  CHECK(fixes[0][1].status == "converged");
  CHECK(fixes[0][2].status == "too_few_objects");
}

TEST_CASE("what cannot be said about measured data is refused") {
  const auto refusal = [](const std::string& text) {
    return tests::refusal_of([&] { studies::EpochSolver(study_of(text), {}, core::best_isa()); });
  };
  CHECK(tests::lacking(refusal("experiment = \"ranging\"\n[[method]]\nsolver = \"rr\"\nk = \"oracle_elem\"\n"),
                       {"oracle_elem", "needs the true position"}) == "");
  CHECK(
      tests::lacking(refusal("experiment = \"ranging\"\n[sweep]\ntheta_m = [0.1, 0.2]\n[[method]]\nsolver = \"rrr\"\n"),
                     {"sweeps theta_m", "--solver"}) == "");
  CHECK(tests::lacking(refusal(exact_solvers + "[scene]\nz_mode = \"fixed\"\n"), {"z_mode", "--start"}) == "");
  CHECK(tests::lacking(
            refusal("experiment = \"ranging\"\n[scene]\nmodel = \"pseudorange\"\n[[method]]\nsolver = \"ols\"\n"),
            {"pseudorange"}) == "");
}
