#include "core/random.hpp"

#include <cmath>

#include "tests/support/catch.hpp"

using namespace ridgeloc::core;

TEST_CASE("uniforms are never 0 or 1 and use their bits as stated") {
  CHECK(uniform(0, 0) == 0x1p-53);
  CHECK(uniform(0xffffffff, 0xffffffff) == 1.0 - 0x1p-53);
  CHECK(uniform(0, 0x80000000) == 0.5 + 0x1p-53);
  CHECK(uniform(0x00000fff, 0) == 0x1p-53);  // the lowest twelve bits are not used
  CHECK(uniform_pair({0, 0x80000000, 0xffffffff, 0xffffffff}) == std::array{0.5 + 0x1p-53, 1.0 - 0x1p-53});
}

TEST_CASE("three uniforms share one block without sharing bits") {
  constexpr double grid = 0x1p-42;
  CHECK(uniform_triple({0, 0, 0, 0}) == std::array{0.5 * grid, 0.5 * grid, 0.5 * grid});
  CHECK(uniform_triple({0x80000000, 0x40000000, 0x20000000, 0}) ==
        std::array{0.5 + 0.5 * grid, 0.25 + 0.5 * grid, 0.125 + 0.5 * grid});
  // Ten bits each of the fourth word: 1, 2 and 4 on the grid.
  CHECK(uniform_triple({0, 0, 0, 1U | 2U << 10 | 4U << 20}) == std::array{1.5 * grid, 2.5 * grid, 4.5 * grid});
}

TEST_CASE("normals are those of Box and Muller") {
  const auto z = normal_pair(std::array{std::exp(-2.0), 1.0 / 8.0});  // radius 2, an eighth of a turn
  CHECK(z[0] == Approx(std::sqrt(2.0)).epsilon(1e-15));
  CHECK(z[1] == Approx(std::sqrt(2.0)).epsilon(1e-15));
  CHECK(std::isfinite(normal_pair(std::array{0x1p-53, 0.5})[0]));
}

TEST_CASE("unit vectors have unit length") {
  for (const double u : {0x1p-53, 0.1, 0.5, 0.9, 1.0 - 0x1p-53}) {
    const auto v = unit_vector(std::array{u, 0.3});
    CHECK(v[0] * v[0] + v[1] * v[1] + v[2] * v[2] == Approx(1.0).epsilon(4e-16));
    CHECK(v[2] == 2.0 * u - 1.0);
  }
}
