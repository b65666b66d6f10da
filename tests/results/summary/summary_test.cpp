#include "results/summary/summary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string_view>
#include <vector>

#include "results/statistics/interval.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc::results;
using ridgeloc::tests::infinity;

const SummaryRow& row_of(const std::vector<SummaryRow>& rows, std::size_t cell, std::size_t method,
                         std::string_view metric) {
  const auto found = std::find_if(rows.begin(), rows.end(), [&](const SummaryRow& row) {
    return row.cell == cell && row.method == method && row.metric == metric;
  });
  REQUIRE(found != rows.end());
  return *found;
}

/// One cell and one method with a single metric.
SummaryRow row_of_values(const std::vector<double>& values, bool whole_numbers = false, bool heavy_tailed = false) {
  Summary summary;
  summary.header.schema.metrics = {{"m", "m", "", heavy_tailed, whole_numbers}};
  summary.header.cells = {{"cell", {}}};
  summary.header.methods = {{"rr", "", ""}};
  Statistics statistics;
  statistics.trials = values.size();
  statistics.metrics = {statistics_of(values)};
  summary.statistics = {statistics};
  return summary_rows(summary).at(0);
}

TEST_CASE("quantiles of counts are whole numbers") {
  const SummaryRow row = row_of_values({3, 6, 6, 6, 7, 7, 9, 9, 9, 30, 30}, true);
  CHECK(row.p25 == 6.0);
  CHECK(row.p50 == 7.0);
  CHECK(row.p75 == 9.0);
  CHECK(row.p50_lo == std::floor(row.p50_lo));
  for (const double n : {31.0, 32.0, 33.0, 48.0, 63.0})
    CHECK(row_of_values({n, n, n, 1000, 1000, 1000, 1000}, true).p25 == n);
  CHECK(row_of_values({48, 1000}, true).p50 == 48.0);
}

TEST_CASE("rows come by cell, method, metric, with the events last") {
  const std::vector<SummaryRow> rows = summary_rows(synthetic_summary());
  REQUIRE(rows.size() == 4 * 2 * 5);
  CHECK(rows[0].metric == "error_m");
  CHECK(rows[1].metric == "error_all_m");
  CHECK(rows[4].metric == "stationary");
  CHECK(rows[5].method == 1);
  CHECK(rows[10].cell == 1);
}

TEST_CASE("a metric's row holds its moments and quantiles") {
  const std::vector<SummaryRow> rows = summary_rows(synthetic_summary());
  const SummaryRow& row = row_of(rows, 0, 0, "error_m");
  CHECK(row.unit == "m");
  CHECK(row.n == 4);
  CHECK(row.beyond == 0);
  CHECK(row.mean == 2.5);
  CHECK(row.sd == Approx(std::sqrt(5.0 / 3.0)));
  CHECK(row.mcse == Approx(std::sqrt(5.0 / 12.0)));
  CHECK(row.min == 1.0);
  CHECK(row.max == 4.0);
  CHECK(row.p50 == 2.0 + 2.0 / 32);
  CHECK_FALSE(row.trusted);  // four values
}

TEST_CASE("a failed trial enters the median, not the mean, and takes the mean's trust") {
  const SummaryRow row = row_of(summary_rows(synthetic_summary()), 0, 0, "error_all_m");
  CHECK(row.n == 5);
  CHECK(row.beyond == 1);
  CHECK(row.mean == 2.5);
  CHECK(row.p50 == 3.0 + 0.5 * 2.0 / 32);
  CHECK(row.p95 == infinity);
  CHECK(row.max == infinity);
}

TEST_CASE("an event's row holds its rate and Wilson's interval") {
  const SummaryRow row = row_of(summary_rows(synthetic_summary()), 3, 1, "converged");
  CHECK(row.unit == "1");
  CHECK(row.n == 5);
  CHECK(row.mean == 0.8);
  CHECK(row.mcse == Approx(std::sqrt(0.8 * 0.2 / 5.0)));
  CHECK(row.lo == wilson_interval(4, 5).lo);
  CHECK(row.hi == wilson_interval(4, 5).hi);
  for (const double undefined : {row.sd, row.sd_mcse, row.min, row.max, row.p50, row.p50_lo}) {
    CHECK(std::isnan(undefined));
  }
}

TEST_CASE("a rate's bar is trusted from ten outcomes of either kind on") {
  const auto trusted = [](std::uint64_t count, std::uint64_t trials) {
    Summary summary;
    summary.header.schema.events = {{"e", ""}};
    summary.header.cells = {{"cell", {}}};
    summary.header.methods = {{"rr", "", ""}};
    summary.statistics = {Statistics{trials, {count}, {}}};
    return summary_rows(summary).at(0).trusted;
  };
  CHECK_FALSE(trusted(0, 100));
  CHECK_FALSE(trusted(9, 100));
  CHECK(trusted(10, 100));
  CHECK(trusted(90, 100));
  CHECK_FALSE(trusted(91, 100));
  CHECK_FALSE(trusted(100, 100));
}

TEST_CASE("a mean's bar is trusted from ten values on, and never without spread") {
  CHECK_FALSE(row_of_values({1, 2, 3, 4, 5, 6, 7, 8, 9}).trusted);
  CHECK(row_of_values({1, 2, 3, 4, 5, 6, 7, 8, 9, 10}).trusted);
  const SummaryRow constant = row_of_values(std::vector<double>(10, 2.0));
  CHECK_FALSE(constant.trusted);
  CHECK(constant.mcse == 0.0);
  CHECK(constant.sd_mcse == 0.0);
  std::vector<double> rounded(10, 1.0);
  rounded[3] = 1.0 - 0x1p-53;
  CHECK_FALSE(row_of_values(rounded).trusted);
  CHECK_FALSE(row_of_values(rounded).rms_trusted);
}

TEST_CASE("a mean's bar is not trusted where one value carries the variance") {
  // n equal values and one other: M4 / M2^2 tends to 1, so the variance of the variance does too.
  std::vector<double> values(1000, 1.0);
  values.back() = 100.0;
  CHECK_FALSE(row_of_values(values).trusted);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i);
  CHECK(row_of_values(values).trusted);
  values.back() = infinity;
  CHECK_FALSE(row_of_values(values).trusted);
}

TEST_CASE("the bar of a root mean square needs more than that of a mean, and heavy tails more than light ones") {
  // Of n values spread evenly up to 1 and one of b, that one has about (b^2 - 1/3)^2 of n 4/45 + (b^2 - 1/3)^2, and
  // (b - 1/2)^4 of (n / 12 + (b - 1/2)^2)^2 in the variance of the variance.
  const auto row = [](double largest, bool heavy_tailed) {
    std::vector<double> values;
    for (int i = 0; i < 1000; ++i) values.push_back((i + 0.5) / 1000.0);
    values.push_back(largest);
    return row_of_values(values, false, heavy_tailed);
  };
  CHECK(row(2.0, false).rms_trusted);        // a share of 0.13
  CHECK_FALSE(row(2.5, false).rms_trusted);  // 0.28
  CHECK(row(2.5, false).trusted);            // 0.004
  CHECK_FALSE(row(2.0, true).rms_trusted);
  CHECK(row(1.5, true).rms_trusted);  // 0.04
  CHECK(row(4.5, false).trusted);     // 0.03
  CHECK_FALSE(row(4.5, true).trusted);
  CHECK_FALSE(row(infinity, false).rms_trusted);
}

TEST_CASE("quantiles of equal values are that value") {
  const SummaryRow row = row_of_values(std::vector<double>(20, 0.3));
  for (const double quantile : {row.p05, row.p25, row.p50, row.p75, row.p95, row.p50_lo, row.p50_hi}) {
    CHECK(quantile == 0.3);
  }
}

TEST_CASE("quantiles near the largest value are told apart though one bin holds them all") {
  std::vector<double> values;
  for (int i = 0; i <= 1000; ++i) values.push_back(0.990 + 1e-6 * i);
  const SummaryRow row = row_of_values(values);
  CHECK(row.p50 == Approx(0.9905).epsilon(1e-6));
  CHECK(row.p95 == Approx(0.99095).epsilon(1e-6));
  CHECK(row.p95_lo < row.p95);
  CHECK(row.p95 < row.p95_hi);
  CHECK(row.p95_hi < row.max);
}

TEST_CASE("a metric with negative values has a mean but no quantiles") {
  const SummaryRow row = row_of_values({-1.0, 1.0, 3.0});
  CHECK(row.mean == 1.0);
  CHECK(row.min == -1.0);
  CHECK(std::isnan(row.p50));
  CHECK(std::isnan(row.p50_hi));
}

TEST_CASE("what a method reports nowhere is left out; an empty population here stays as n = 0") {
  Summary summary = synthetic_summary();
  const double not_a_number = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t cell = 0; cell < 4; ++cell) {
    Statistics& silent = summary.statistics[2 * cell];  // method rr
    silent.metrics[0] =
        statistics_of(std::vector{not_a_number, not_a_number, not_a_number, not_a_number, not_a_number});
    silent.events.clear();
  }
  summary.statistics[1].metrics[0] = statistics_of(
      std::vector{not_a_number, not_a_number, not_a_number, not_a_number, not_a_number});  // cell 0, method rrr
  const std::vector<SummaryRow> rows = summary_rows(summary);
  CHECK(rows.size() == 4 * (1 + 5));
  const SummaryRow& empty = row_of(rows, 0, 1, "error_m");
  CHECK(empty.n == 0);
  CHECK(std::isnan(empty.mean));
  CHECK_FALSE(empty.trusted);
}

TEST_CASE("a cell that is not computed yet has rows with n = 0") {
  Summary summary = synthetic_summary();
  summary.statistics[0] = Statistics{};
  const std::vector<SummaryRow> rows = summary_rows(summary);
  CHECK(row_of(rows, 0, 0, "error_m").n == 0);
  CHECK(row_of(rows, 0, 0, "converged").n == 0);
  CHECK(std::isnan(row_of(rows, 0, 0, "converged").lo));
}

}  // namespace
