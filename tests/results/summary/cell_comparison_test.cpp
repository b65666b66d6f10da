#include "results/summary/cell_comparison.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

#include "results/statistics/interval.hpp"
#include "results/tables/csv.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;

constexpr std::size_t trials = 200;
constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

/// The errors of a cell in each trial: those of the cells with more noise are larger, and go with those of the others.
std::vector<double> errors(std::size_t points, std::size_t sigma) {
  std::vector<double> values;
  for (std::size_t t = 0; t < trials; ++t) {
    const double common = 1.0 + 0.5 * std::sin(static_cast<double>(t));
    values.push_back((sigma == 0 ? 1.0 : 3.0) * common + 0.01 * std::cos(11.0 * static_cast<double>(t + points)));
  }
  return values;
}

/// A study of one method over two axes, and its trials.
struct Sample {
  Summary summary = synthetic_summary();
  std::vector<std::vector<double>> values;  ///< by cell
  std::size_t kept = trials;

  Sample() {
    summary.header.methods.resize(1);
    summary.header.trials = trials;
    summary.statistics.clear();
    for (const CellInfo& cell : summary.header.cells) {
      values.push_back(errors(cell.indices[0], cell.indices[1]));
      add();
    }
  }

  void add() {
    Statistics statistics;
    statistics.trials = trials;
    statistics.metrics = {statistics_of(values.back()), MetricStatistics()};
    summary.statistics.push_back(statistics);
  }

  TrialReader reader() const {
    return [this](std::size_t cell, std::size_t) {
      TrialTable table;
      for (std::size_t t = 0; t < kept; ++t) table.trial.push_back(t);
      table.metrics = {{values[cell].begin(), values[cell].begin() + static_cast<std::ptrdiff_t>(kept)}, {}};
      return table;
    };
  }

  std::vector<CellComparison> compared(const std::string& base) const {
    return compare_cells(summary, axis_value(summary.header, base), reader());
  }
};

TEST_CASE("cells are compared trial by trial where both keep them") {
  const Sample sample;
  const auto comparisons = sample.compared("range_sigma_m=0.1");
  REQUIRE(comparisons.size() == 2);
  CHECK(comparisons[0].cell == 1);
  CHECK(comparisons[0].against == 0);
  CHECK(comparisons[1].cell == 3);
  CHECK(comparisons[1].against == 2);
  const CellComparison& pair = comparisons[0];
  std::vector<double> differences;
  for (std::size_t t = 0; t < trials; ++t) differences.push_back(sample.values[1][t] - sample.values[0][t]);
  const Moments moments = moments_of(differences);
  CHECK(pair.difference.value == Approx(moments.mean));
  CHECK(pair.difference.error == Approx(mean_standard_error(moments)));
  CHECK(pair.difference.lo == Approx(mean_interval(moments).lo));
  CHECK(pair.ratio.value == Approx(3.0).epsilon(0.01));
  CHECK(pair.correlation > 0.99);
  CHECK(pair.paired == trials);
  CHECK(pair.trusted);
}

TEST_CASE("some of the trials are enough for the correlation") {
  Sample sample;
  const double all = sample.compared("range_sigma_m=0.1")[0].difference.error;
  sample.kept = 100;
  const CellComparison half = sample.compared("range_sigma_m=0.1")[0];
  CHECK(half.paired == 100);
  CHECK(half.n == trials);
  CHECK(half.difference.error == Approx(all).epsilon(0.05));
}

TEST_CASE("without common trials means count as independent") {
  Sample sample;
  const auto is_independent = [&] {
    const CellComparison pair = sample.compared("range_sigma_m=0.1")[0];
    const double error = std::hypot(mean_standard_error(sample.summary.statistics[1].metrics[0].moments),
                                    mean_standard_error(sample.summary.statistics[0].metrics[0].moments));
    return pair.paired == 0 && std::isnan(pair.correlation) && pair.difference.error == Approx(error);
  };
  sample.kept = 9;
  CHECK(is_independent());
  sample.kept = 0;
  CHECK(is_independent());
  sample.kept = trials;
  CHECK_FALSE(is_independent());
  // Shares of two cells need not have the same blocks.
  sample.summary.header.trials = trials + 1;
  CHECK(is_independent());
}

TEST_CASE("trials that are in one population only say nothing of the correlation") {
  Sample sample;
  // Every third trial has failed in the first cell.
  for (std::size_t t = 0; t < trials; t += 3) sample.values[0][t] = nan_value;
  sample.summary.statistics[0].metrics[0] = statistics_of(sample.values[0]);
  const CellComparison pair = sample.compared("range_sigma_m=0.1")[0];
  const Moments& a = sample.summary.statistics[1].metrics[0].moments;
  const Moments& b = sample.summary.statistics[0].metrics[0].moments;
  // The variance of the difference of means from what each trial adds to it.
  double variance = 0.0;
  for (std::size_t t = 0; t < trials; ++t) {
    const double second = std::isnan(sample.values[0][t]) ? 0.0 : (sample.values[0][t] - b.mean) / double(b.n);
    const double part = (sample.values[1][t] - a.mean) / double(a.n) - second;
    variance += part * part;
  }
  CHECK(pair.difference.error == Approx(std::sqrt(variance)).epsilon(0.01));
}

TEST_CASE("a cell with more trials shares those that both have") {
  Sample sample;
  const CellComparison equal = sample.compared("range_sigma_m=0.1")[0];
  std::vector<double> four;
  for (int i = 0; i < 4; ++i) four.insert(four.end(), sample.values[1].begin(), sample.values[1].end());
  sample.summary.statistics[1].metrics[0] = statistics_of(four);
  sample.summary.statistics[1].trials = 4 * trials;
  const CellComparison more = sample.compared("range_sigma_m=0.1")[0];
  const double a = mean_standard_error(sample.summary.statistics[1].metrics[0].moments);
  const double b = mean_standard_error(sample.summary.statistics[0].metrics[0].moments);
  CHECK(more.difference.error == Approx(std::sqrt(a * a + b * b - equal.correlation * a * b)));
}

TEST_CASE("only cells that differ in the axis alone are compared") {
  Sample sample;
  sample.summary.header.cells.pop_back();
  CHECK(sample.compared("range_sigma_m=0.1").size() == 1);
  CHECK(sample.compared("points=3").size() == 1);
  sample.summary.header.cells = {{"a", {0, 0}}, {"b", {1, 1}}};
  CHECK(tests::message_of([&] { sample.compared("points=3"); }) ==
        "no two cells differ in points alone, one of them with 3; choose another axis");
}

TEST_CASE("what is no value of an axis is refused with those that are") {
  const Header header = synthetic_summary().header;
  CHECK(axis_value(header, "range_sigma_m=0.50").value == 1);
  const auto refusal = [&](const char* text) { return tests::message_of([&] { axis_value(header, text); }); };
  CHECK(refusal("sigma=0.1") == "sigma=0.1: no axis \"sigma\" (allowed: points, range_sigma_m)");
  CHECK(refusal("points=4") == "points=4: not one value of points (allowed: 3, 5)");
  CHECK(refusal("points=3,5") == "points=3,5: not one value of points (allowed: 3, 5)");
  CHECK_FALSE(refusal("points").empty());
}

TEST_CASE("comparisons of cells as CSV") {
  const Sample sample;
  std::ostringstream out;
  write_cell_comparisons_csv(sample.summary.header, sample.compared("points=3"), out);
  CHECK(out.str().starts_with(
      "points,range_sigma_m,against,method,metric,unit,n,n_against,difference,difference_mcse,difference_lo,"
      "difference_hi,ratio,ratio_mcse,ratio_lo,ratio_hi,correlation,paired,trusted\n"
      "5,0.1,\"points = 3, range_sigma_m = 0.1\",rr,error_m,m,200,200,"));
}

}  // namespace
