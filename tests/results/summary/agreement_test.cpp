#include "results/summary/agreement.hpp"

#include <cmath>
#include <random>

#include "tests/support/catch.hpp"
#include "tests/support/sample_study.hpp"

using namespace ridgeloc::results;

namespace {

/// A result of one cell and one method: a metric that is normal with the given mean, a heavy-tailed one, and a rate.
Summary sample(unsigned seed, double mean, double rate, std::size_t trials = 4000) {
  Header header;
  header.schema.metrics = {{"error_m", "m", ""}, {"error_all_m", "m", "", true}};
  header.schema.events = {{"converged", ""}};
  header.schema.statuses = 1;
  header.cells = {{"c", {}}};
  header.methods = {{"rr", "m", ""}};
  header.trials = trials;
  std::mt19937_64 engine(seed);
  std::normal_distribution<double> normal(mean, 1.0);
  std::bernoulli_distribution event(rate);
  std::vector<double> light, heavy;
  Statistics statistics;
  statistics.trials = trials;
  statistics.events = {0};
  for (std::size_t t = 0; t < trials; ++t) {
    light.push_back(normal(engine));
    heavy.push_back(std::exp(normal(engine)));
    statistics.events[0] += event(engine) ? 1 : 0;
  }
  statistics.metrics = {statistics_of(light), statistics_of(heavy)};
  return {header, {statistics}};
}

}  // namespace

TEST_CASE("results that differ by chance agree, each number by its own statistic") {
  const Agreement agreement = agreement_of(sample(1, 5.0, 0.3), sample(2, 5.0, 0.3));
  REQUIRE(agreement.pairs.size() == 3);
  CHECK(agreement.untested == 0);
  // The chance 1e-3 / 3 on both sides.
  CHECK(std::erfc(agreement.limit / std::sqrt(2.0)) == Approx(1e-3 / 3.0).epsilon(1e-6));
  CHECK(agreement.holds);
  for (const NumberPair& pair : agreement.pairs) {
    const std::string expected = pair.metric == "error_m" ? "mean" : pair.metric == "converged" ? "rate" : "median";
    CHECK(pair.statistic == expected);
  }
}

TEST_CASE("a difference of a mean, of a median or of a rate is found") {
  CHECK_FALSE(agreement_of(sample(1, 5.0, 0.3), sample(2, 5.2, 0.3)).holds);
  CHECK_FALSE(agreement_of(sample(1, 5.0, 0.3), sample(2, 5.0, 0.36)).holds);
  const Agreement agreement = agreement_of(sample(1, 5.0, 0.3), sample(2, 5.2, 0.3));
  CHECK(agreement.pairs.front().metric != "converged");
  CHECK(agreement.pairs.front().standard_errors < -agreement.limit);
}

TEST_CASE("rates of 0 and 1 are compared too, and equal numbers never differ") {
  CHECK(agreement_of(sample(1, 5.0, 0.0), sample(2, 5.0, 0.0)).holds);
  CHECK_FALSE(agreement_of(sample(1, 5.0, 0.0), sample(2, 5.0, 0.02)).holds);
  const Agreement same = agreement_of(sample(1, 5.0, 0.3), sample(1, 5.0, 0.3));
  for (const NumberPair& pair : same.pairs) CHECK(pair.standard_errors == 0.0);
}

TEST_CASE("cells and methods that only one has are not compared") {
  Summary other = sample(2, 5.0, 0.3);
  other.header.methods[0].hash = "another";
  const Agreement agreement = agreement_of(sample(1, 5.0, 0.3), other);
  CHECK(agreement.pairs.empty());
  CHECK(agreement.holds);
}

TEST_CASE("equal studies are said to disagree as rarely as stated") {
  // 400 pairs with a chance of at most 1e-3 each: more than 3 have a chance below 1e-3.
  int alarms = 0;
  for (unsigned seed = 0; seed < 400; ++seed)
    alarms += agreement_of(sample(2 * seed + 10, 5.0, 0.3, 400), sample(2 * seed + 11, 5.0, 0.3, 400)).holds ? 0 : 1;
  CHECK(alarms <= 3);
}
