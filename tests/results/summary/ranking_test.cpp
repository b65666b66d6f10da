#include "results/summary/ranking.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;

/// One cell with methods whose values in trial i share a part that is much larger than what they differ by: b is
/// `gap` above a, c as far above b; b and c are compared with a if `compared` says so.
Summary three_methods(double gap, bool compared) {
  constexpr std::size_t trials = 400;
  std::mt19937_64 engine(7);
  std::normal_distribution<double> normal;
  std::vector<std::vector<double>> values(3, std::vector<double>(trials));
  for (std::size_t i = 0; i < trials; ++i) {
    const double shared = 10.0 + normal(engine);
    for (std::size_t m = 0; m < 3; ++m) values[m][i] = shared + gap * static_cast<double>(m) + 0.01 * normal(engine);
  }
  Summary summary;
  summary.header.schema = synthetic_schema();
  summary.header.schema.metrics[0].is_compared = true;
  summary.header.cells = {{"cell", {}}};
  summary.header.methods = {{"a", "1", ""}, {"b", "2", ""}, {"c", "3", ""}};
  const auto add = [&](const std::vector<double>& of_metric, bool is_solver) {
    Statistics statistics;
    statistics.trials = trials;
    if (is_solver) statistics.events = {trials, 0, trials};
    statistics.metrics = {statistics_of(of_metric), {}};
    summary.statistics.push_back(statistics);
  };
  for (const auto& of_method : values) add(of_method, true);
  if (!compared) return summary;
  for (const std::size_t m : {std::size_t{1}, std::size_t{2}}) {
    summary.header.methods.push_back({"difference", "4", "", std::array<std::size_t, 2>{m, 0}});
    std::vector<double> difference(trials);
    for (std::size_t i = 0; i < trials; ++i) difference[i] = values[m][i] - values[0][i];
    add(difference, false);
  }
  return summary;
}

const std::vector<std::size_t> all = {0, 1, 2};

Measure first_measure(const Summary& summary) {
  return measures_of(summary.header.schema).front();
}

TEST_CASE("paired differences show what means alone do not") {
  // The means differ by 0.02 with standard errors of 0.05 each, the pairs with one of 0.0007.
  const Summary paired = three_methods(0.02, true);
  const auto ranking = ranking_of(paired, 0, all, first_measure(paired));
  REQUIRE(ranking);
  CHECK(ranking->best == 0);
  CHECK(ranking->is_significant());
  const Summary alone = three_methods(0.02, false);
  CHECK(ranking_of(alone, 0, all, first_measure(alone))->rivals == std::vector<std::size_t>{1, 2});
  const Summary far = three_methods(1.0, false);
  CHECK(ranking_of(far, 0, all, first_measure(far))->is_significant());
}

TEST_CASE("two methods that are compared with a third are compared through it") {
  const Summary summary = three_methods(-0.02, true);  // c is best, and only compared with a
  const auto ranking = ranking_of(summary, 0, all, first_measure(summary));
  CHECK(ranking->best == 2);
  CHECK(ranking->is_significant());
  CHECK(ranking_of(summary, 0, {1, 2}, first_measure(summary))->is_significant());
}

TEST_CASE("equal methods are rivals: the best of three stands out by chance in at most 5 % of 2000 cells") {
  // The chance of more than 5 % + 4 standard errors is below 4e-5 if it is 5 %; Bonferroni keeps it below.
  std::mt19937_64 engine(11);
  std::normal_distribution<double> normal;
  Summary summary = three_methods(0.0, false);
  std::size_t significant = 0;
  constexpr int cells = 2000;
  for (int cell = 0; cell < cells; ++cell) {
    std::vector<std::vector<double>> values(3, std::vector<double>(50));
    for (auto& of_method : values)
      for (double& value : of_method) value = normal(engine);
    for (std::size_t m = 0; m < 3; ++m) summary.statistics[m].metrics[0] = statistics_of(values[m]);
    significant += ranking_of(summary, 0, all, first_measure(summary))->is_significant() ? 1 : 0;
  }
  CHECK(significant < static_cast<std::size_t>(cells * 0.05 + 4.0 * 9.75));
}

/// Three methods with one value in each trial, drawn apart: t / |u|, of which no mean exists, times 1, 1 and `factor`.
Summary heavy_tailed(std::mt19937_64& engine, std::size_t trials, double factor) {
  std::cauchy_distribution<double> cauchy;
  Summary summary = three_methods(0.0, false);
  for (std::size_t m = 0; m < 3; ++m) {
    std::vector<double> values(trials);
    for (double& value : values) value = std::abs(cauchy(engine)) * (m == 2 ? factor : 1.0);
    summary.statistics[m].trials = trials;
    summary.statistics[m].metrics[0] = statistics_of(values);
  }
  return summary;
}

TEST_CASE("where no mean exists, medians show what they can, and a mean as leading number shows nothing") {
  std::mt19937_64 engine(13);
  const Summary summary = heavy_tailed(engine, 2000, 2.0);
  Measure measure = first_measure(summary);
  measure.lead = Measure::Lead::Median;
  const auto ranking = ranking_of(summary, 0, all, measure);
  CHECK(ranking->best != 2);
  CHECK(ranking->rivals.size() == 1);
  CHECK(ranking->rivals.front() != 2);
}

TEST_CASE("a method that mostly has no finite error is worse than one that has") {
  std::mt19937_64 engine(19);
  Summary summary = heavy_tailed(engine, 2000, 1.0);
  std::vector<double> values(2000, 1.0);
  std::fill(values.begin(), values.begin() + 1200, std::numeric_limits<double>::infinity());
  summary.statistics[2].metrics[0] = statistics_of(values);
  Measure measure = first_measure(summary);
  measure.lead = Measure::Lead::Median;
  const auto ranking = ranking_of(summary, 0, all, measure);
  CHECK(ranking->best != 2);
  CHECK(std::ranges::find(ranking->rivals, std::size_t{2}) == ranking->rivals.end());
}

TEST_CASE("equal medians are rivals: the best of three stands out by chance in at most 5 % of 1000 cells") {
  // The chance of more than 5 % + 4 standard errors is below 4e-5 if it is 5 %.
  std::mt19937_64 engine(17);
  std::size_t significant = 0;
  constexpr int cells = 1000;
  for (int cell = 0; cell < cells; ++cell) {
    const Summary summary = heavy_tailed(engine, 100, 1.0);
    Measure measure = first_measure(summary);
    measure.lead = Measure::Lead::Median;
    significant += ranking_of(summary, 0, all, measure)->is_significant() ? 1 : 0;
  }
  CHECK(significant < static_cast<std::size_t>(cells * 0.05 + 4.0 * 6.9));
}

TEST_CASE("what has no values has no rank, and a difference that is not reliable shows nothing") {
  Summary summary = three_methods(0.02, true);
  summary.statistics[4].metrics[0].beyond = 1;
  CHECK(ranking_of(summary, 0, all, first_measure(summary))->rivals == std::vector<std::size_t>{2});
  summary.statistics[1].metrics[0] = {};
  CHECK(ranking_of(summary, 0, all, first_measure(summary))->rivals == std::vector<std::size_t>{2});
  summary.statistics[2].metrics[0] = {};
  CHECK_FALSE(ranking_of(summary, 0, all, first_measure(summary)));
}

TEST_CASE("methods are ranked by what all trials have, in the unit of what is compared first") {
  Summary summary = synthetic_summary();
  CHECK_FALSE(ranking_measure(summary));
  Schema& schema = summary.header.schema;
  schema.metrics[0].is_compared = true;
  CHECK(ranking_measure(summary)->name == "error_m");
  schema.metrics[1].is_compared = true;
  CHECK(ranking_measure(summary)->name == "error_all_m");
  CHECK(ranking_measures(summary).size() == 2);
  schema.metrics[1].unit = "m2";
  CHECK(ranking_measure(summary)->name == "error_m");
  CHECK(ranking_measures(summary).size() == 1);
}

TEST_CASE("a result that has been read knows what is compared by its differences") {
  Summary summary = three_methods(0.02, true);
  summary.header.schema.metrics[0].is_compared = false;
  CHECK(ranking_measure(summary)->name == "error_m");
  Summary alone = three_methods(0.02, false);
  alone.header.schema.metrics[0].is_compared = false;
  CHECK_FALSE(ranking_measure(alone));
}

}  // namespace
