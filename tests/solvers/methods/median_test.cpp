#include "solvers/methods/median.hpp"

#include <algorithm>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"

using namespace ridgeloc;

TEST_CASE("sort_lanes sorts as std::sort does, and the median is the middle or the mean of the middle two") {
  std::mt19937_64 engine(3);
  std::vector<std::size_t> sizes;
  for (std::size_t n = 1; n <= 40; ++n) sizes.push_back(n);
  sizes.push_back(1000);
  for (const std::size_t n : sizes) {
    for (int round = 0; round < 20; ++round) {
      // Every other time from few values, so that many are equal.
      std::uniform_int_distribution<int> values(0, round % 2 == 0 ? 1'000'000 : 4);
      std::vector<double> sorted(n);
      for (double& value : sorted) value = values(engine);
      std::vector<double> by_lanes = sorted;
      std::vector<double> for_median = sorted;
      std::ranges::sort(sorted);
      solvers::sort_lanes<double>(by_lanes.data(), n);
      CAPTURE(n, round);
      CHECK(by_lanes == sorted);
      CHECK(solvers::median<double>(for_median.data(), n) == 0.5 * (sorted[(n - 1) / 2] + sorted[n / 2]));
    }
  }
}

TEST_CASE("up to 14 zeros and ones are sorted in every order, and so is then everything (Knuth, zero-one principle)") {
  for (std::size_t n = 1; n <= 14; ++n) {
    std::size_t wrong = 0;
    for (unsigned bits = 0; bits < 1U << n; ++bits) {
      std::vector<double> values(n);
      for (std::size_t i = 0; i < n; ++i) values[i] = bits >> i & 1U;
      solvers::sort_lanes<double>(values.data(), n);
      wrong += std::ranges::is_sorted(values) ? 0 : 1;
    }
    CHECK(wrong == 0);
  }
}

TEST_CASE("infinities sort to the end") {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::vector<double> values = {infinity, 3.0, infinity, 1.0, 2.0};
  CHECK(solvers::median<double>(values.data(), 5) == 3.0);
}
