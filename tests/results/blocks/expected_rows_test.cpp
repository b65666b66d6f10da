#include "results/blocks/expected_rows.hpp"

#include <cmath>
#include <cstdint>
#include <random>
#include <utility>
#include <vector>

#include "tests/support/catch.hpp"

using namespace ridgeloc::results;

namespace {

/// A row of so many trials with a metric of a wide spread, one with heavy tails and one of yes or no.
Row sample_row(std::uint64_t trials) {
  std::mt19937_64 random(5);
  std::lognormal_distribution<double> wide(0.0, 1.0);
  std::cauchy_distribution<double> heavy;
  std::vector<double> of_wide, of_heavy, of_yes_no;
  for (std::uint64_t t = 0; t < trials; ++t) {
    of_wide.push_back(wide(random));
    of_heavy.push_back(std::abs(heavy(random)));
    of_yes_no.push_back(t % 3 == 0 ? 1.0 : 0.0);
  }
  Row row{2, 1, 1, 1, {}, {7}};
  row.statistics.trials = trials;
  row.statistics.events = {trials / 4, trials - trials / 4};
  row.statistics.metrics = {statistics_of(of_wide), statistics_of(of_heavy), statistics_of(of_yes_no)};
  return row;
}

double bins_of(const Row& row, std::size_t metric) {
  return static_cast<double>(row.statistics.metrics[metric].histogram.bins().size());
}

}  // namespace

TEST_CASE("as many rows are expected as runs of blocks that are not merged") {
  const Row row = sample_row(100);
  for (const auto& [trials, rows] : std::vector<std::pair<std::uint64_t, std::size_t>>{
           {1, 1}, {4096, 1}, {4097, 2}, {7 * 4096, 3}, {8 * 4096, 1}, {8 * 4096 + 1, 2}}) {
    const std::vector<Row> expected = expected_rows(row, trials, 4096);
    CHECK(expected.size() == rows);
    std::uint64_t sum = 0;
    for (const Row& one : expected) {
      sum += one.statistics.trials;
      CHECK(one.cell == 2);
      CHECK(one.method == 1);
      CHECK(one.blocks == 1);
      CHECK(one.digests.size() == 1);
    }
    CHECK(sum == trials);
  }
}

TEST_CASE("histograms grow as those of more trials do, and shrink as those of fewer") {
  const std::uint64_t few = GENERATE(64, 1000);
  // Of 64 trials nearly all are alone in their bins, and say little of the tails.
  const double limit = few == 64 ? 2.0 : 1.5;
  for (const std::uint64_t many : {std::uint64_t{50}, std::uint64_t{4096}, std::uint64_t{1} << 18}) {
    const Row expected = expected_rows(sample_row(few), many, many).front();
    const Row truth = sample_row(many);
    for (std::size_t metric = 0; metric < 2; ++metric) {
      CAPTURE(few, many, metric, bins_of(expected, metric), bins_of(truth, metric));
      CHECK(bins_of(expected, metric) < limit * bins_of(truth, metric));
      CHECK(bins_of(truth, metric) < limit * bins_of(expected, metric));
    }
    CHECK(bins_of(expected, 2) == 2);
  }
}
