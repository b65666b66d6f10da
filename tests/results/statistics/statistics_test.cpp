#include "results/statistics/statistics.hpp"

#include <limits>
#include <stdexcept>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc::results;
using ridgeloc::tests::infinity;
using ridgeloc::tests::not_a_number;

TEST_CASE("statistics separate the population, the moments and what lies beyond") {
  const MetricStatistics statistics =
      statistics_of(std::vector{not_a_number, 2.0, infinity, 1.0, 2e6, 3.0, not_a_number, 3.0, 3.0, 0.5});
  CHECK(statistics.moments.n == 6);
  CHECK(statistics.beyond == 2);
  CHECK(statistics.histogram.total() == 8);
  CHECK(statistics.min == 0.5);
  CHECK(statistics.max == infinity);
}

TEST_CASE("statistics of an empty population keep the neutral extremes") {
  CHECK(statistics_of(std::vector{not_a_number, not_a_number}) == MetricStatistics{});
  const MetricStatistics some = statistics_of(std::vector{1.0, 2.0});
  CHECK(merge(some, MetricStatistics{}) == some);
  CHECK(merge(MetricStatistics{}, some) == some);
}

TEST_CASE("extremes are found in every position") {
  for (std::size_t place = 0; place < 19; ++place) {
    std::vector<double> values(19, 1.0);
    values[place] = 7.0;
    CHECK(statistics_of(values).max == 7.0);
    values[place] = -7.0;
    CHECK(statistics_of(values).min == -7.0);
  }
}

TEST_CASE("merging statistics adds counts and merges each metric") {
  const Statistics merged = merge(five_trials(1.0), five_trials(0.5));
  CHECK(merged.trials == 10);
  CHECK(merged.events == std::vector<std::uint64_t>{8, 2, 10});
  CHECK(merged.metrics.size() == 2);
  CHECK(merged.metrics[0].moments.n == 8);
  CHECK(merged.metrics[0].min == 0.5);
  CHECK(merged.metrics[0].max == 4.0);
  CHECK(merged.metrics[1].beyond == 2);
  CHECK(merge(Statistics{}, merged) == merged);
  CHECK(merge(merged, Statistics{}) == merged);
}

TEST_CASE("merging statistics of different schemas is refused") {
  Statistics other = five_trials(1.0);
  other.metrics.pop_back();
  CHECK_THROWS_AS(merge(five_trials(1.0), other), std::invalid_argument);
}

}  // namespace
