#include "studies/measured/epoch_geometry.hpp"

#include <cmath>
#include <string>
#include <vector>

#include "tests/support/catch.hpp"

using namespace ridgeloc;
using studies::Place;

namespace {

studies::EpochGeometry geometry(const std::vector<Place>& objects, bool knows_height = false) {
  studies::Epoch epoch;
  for (const Place& at : objects) epoch.readings.push_back({"", at, 2.0, 1.0});
  return studies::geometry_of_epoch(epoch, knows_height);
}

constexpr double east_m = 500'000.0;
constexpr double north_m = 5'000'000.0;

}  // namespace

TEST_CASE("an epoch says what its objects leave open, at large coordinates too") {
  for (const Place& o : {Place{0, 0, 0}, Place{east_m, north_m, 100}}) {
    const auto at = [&](double x, double y, double z) { return Place{o[0] + x, o[1] + y, o[2] + z}; };
    const auto room = geometry({at(0, 0, 2), at(8, 0, 2), at(8, 6, 1), at(0, 6, 0)});
    CHECK(room.is_solvable);
    CHECK(room.note.empty());
    CHECK(geometry({at(0, 0, 2), at(8, 0, 2), at(8, 6, 1)}).note == "mirror");
    CHECK(geometry({at(0, 0, 2), at(8, 0, 2), at(8, 6, 2), at(0, 6, 2)}).note == "mirror");
    CHECK(geometry({at(0, 0, 0), at(1, 1, 1), at(3, 3, 3)}).note == "around");
    CHECK(geometry({at(0, 0, 2), at(8, 0, 2), at(8, 6, 1), at(0, 0, 2)}).note == "duplicates mirror");

    // With a known height a plane is enough.
    CHECK(geometry({at(0, 0, 2), at(8, 0, 2), at(8, 6, 2)}, true).note.empty());
    CHECK(geometry({at(0, 0, 2), at(8, 0, 1)}, true).note == "mirror");
  }
}

TEST_CASE("an epoch with fewer places than unknowns has no answer") {
  CHECK(!geometry({}).is_solvable);
  CHECK(!geometry({{0, 0, 0}, {1, 0, 0}}).is_solvable);
  CHECK(!geometry({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}}).is_solvable);
  CHECK(geometry({{0, 0, 0}, {1, 0, 0}}, true).is_solvable);
  CHECK(!geometry({{0, 0, 0}}, true).is_solvable);
}

TEST_CASE("a start lies off the plane of the objects, above it, as far as the ranges") {
  const auto flat = geometry({{0, 0, 1}, {4, 0, 1}, {4, 4, 1}, {0, 4, 1}});
  CHECK(std::abs(flat.start[0] - 2.0) < 1e-12);
  CHECK(std::abs(flat.start[1] - 2.0) < 1e-12);
  CHECK(std::abs(flat.start[2] - 3.0) < 1e-12);
}
