#include "results/summary/ratio.hpp"

#include <cmath>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "results/figures/figure_data.hpp"
#include "results/statistics/interval.hpp"
#include "results/tables/csv.hpp"
#include "results/tables/table.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;

/// One cell with two methods and their difference, 20 trials each.
Summary pair_summary() {
  Summary summary = synthetic_summary();
  Header& header = summary.header;
  header.axes[0].values.resize(1);
  header.axes[1].values.resize(2);
  header.cells.resize(2);
  header.methods.push_back({"rrr - rr", "h3", "", std::array<std::size_t, 2>{1, 0}});
  summary.statistics.clear();
  for (std::size_t cell = 0; cell < 2; ++cell) {
    std::vector<double> below, above, difference;
    for (int i = 0; i < 20; ++i) {
      below.push_back(2.0 + std::sin(i));
      above.push_back(1.5 * below.back() + 0.1 * std::cos(7.0 * i));
      difference.push_back(above.back() - below.back());
    }
    // The first method's other metric has a population of its own.
    const std::vector<double> fewer(below.begin(), below.begin() + 15);
    const std::vector<double> common(difference.begin(), difference.begin() + 15);
    for (const auto& [all, own] : {std::pair{below, fewer}, std::pair{above, above}, std::pair{difference, common}}) {
      Statistics statistics;
      statistics.trials = 20;
      statistics.metrics = {statistics_of(all), statistics_of(own)};
      summary.statistics.push_back(statistics);
    }
    summary.statistics[3 * cell].events = {20, 0, 20};
    summary.statistics[3 * cell + 1].events = {20, 0, 20};
  }
  return summary;
}

const SummaryRow& row_of(const std::vector<SummaryRow>& rows, std::size_t method, const std::string& metric) {
  for (const SummaryRow& row : rows)
    if (row.method == method && row.metric == metric) return row;
  throw std::runtime_error("no row of " + metric);
}

TEST_CASE("the error of a ratio is that of the linearised differences trial by trial") {
  const std::vector<double> a = {3.0, 4.5, 6.5, 7.0, 11.0};
  const std::vector<double> b = {1.0, 2.0, 3.0, 4.0, 5.0};
  std::vector<double> differences, influences;
  const double ratio = 32.0 / 15.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    differences.push_back(a[i] - b[i]);
    influences.push_back((a[i] - ratio * b[i]) / 3.0);
  }
  const double covariance = covariance_of_means(statistics_of(a), statistics_of(b), statistics_of(differences));
  const Estimate estimate = ratio_of_means(moments_of(a), moments_of(b), covariance);
  CHECK(estimate.value == Approx(ratio));
  CHECK(estimate.error == Approx(mean_standard_error(moments_of(influences))));
  CHECK(std::log(estimate.hi / ratio) == Approx(student_quantile_975(4) * estimate.error / ratio));
  CHECK(estimate.lo * estimate.hi == Approx(ratio * ratio));
}

TEST_CASE("ratios without an error, of negative means, and of a mean of zero") {
  const Moments one = moments_of(std::vector{1.0});
  const Moments some = moments_of(std::vector{1.0, 2.0, 3.0});
  const Moments negative = moments_of(std::vector{-1.0, -2.0, -3.0});
  const Moments zero = moments_of(std::vector{-1.0, 0.0, 1.0});
  CHECK(std::isnan(ratio_of_means(one, some, 0.0).value));
  CHECK(std::isnan(ratio_of_means(some, zero, 0.0).value));
  const Estimate estimate = ratio_of_means(negative, some, 0.0);
  CHECK(estimate.value == -1.0);
  CHECK(estimate.hi - estimate.value == Approx(estimate.value - estimate.lo));
  CHECK(ratio_of_means(some, some, some.m2 / 6.0).error < 1e-8);
}

TEST_CASE("every difference brings a ratio, whose rows follow those of the methods") {
  const Summary summary = with_ratios(pair_summary());
  REQUIRE(summary.header.methods.size() == 4);
  CHECK(summary.header.methods[3].label == "rrr / rr");
  const auto rows = summary_rows(summary);
  const SummaryRow& ratio = row_of(rows, 3, "error_m");
  CHECK(ratio.unit == "1");
  CHECK(ratio.n == 20);
  CHECK(ratio.mean == Approx(summary.of(0, 1).metrics[0].moments.mean / summary.of(0, 0).metrics[0].moments.mean));
  CHECK(ratio.trusted);
  CHECK(std::isnan(ratio.sd));
  CHECK(std::isnan(ratio.p50));
  // The trials go together: a tenth of the error that independent ones would have.
  CHECK(ratio.mcse <
        0.1 * ratio_of_means(summary.of(0, 1).metrics[0].moments, summary.of(0, 0).metrics[0].moments, 0.0).error);
  for (const SummaryRow& row : rows) CHECK((row.method != 3 || row.metric.starts_with("error")));
}

TEST_CASE("where one method has trials of its own the error lies between the exact one and that of independent means") {
  std::vector<double> a, b, common_a, common_b, difference;
  for (int i = 0; i < 1000; ++i) {
    b.push_back(2.0 + std::sin(i));
    a.push_back(1.5 * b.back() + 0.1 * std::cos(7.0 * i));
    if (i % 50 == 3) b.pop_back();
    if (i % 50 != 3) difference.push_back(a.back() - b.back());
  }
  const MetricStatistics of_a = statistics_of(a);
  const MetricStatistics of_b = statistics_of(b);
  const double covariance = covariance_of_means(of_a, of_b, statistics_of(difference));
  double exact = 0.0;
  for (std::size_t i = 0, k = 0; i < 1000; ++i)
    if (i % 50 != 3) exact += (a[i] - of_a.moments.mean) * (b[k++] - of_b.moments.mean) / (1000.0 * 980.0);
  CHECK(covariance < exact);
  CHECK(covariance > 0.7 * exact);
}

TEST_CASE("where the difference knows too little, means count as independent") {
  const Summary summary = with_ratios(pair_summary());
  const MetricStatistics& above = summary.of(0, 1).metrics[0];
  const MetricStatistics& below = summary.of(0, 0).metrics[0];
  const MetricStatistics& difference = summary.of(0, 2).metrics[0];
  CHECK(covariance_of_means(above, below, difference) > 0.0);
  CHECK(covariance_of_means(above, below, MetricStatistics()) == 0.0);
  MetricStatistics beyond = above;
  beyond.beyond = 1;
  CHECK(covariance_of_means(beyond, below, difference) == 0.0);
  const auto rows = summary_rows(summary);
  const SummaryRow& ratio = row_of(rows, 3, "error_all_m");
  CHECK(ratio.n == 15);
  CHECK(ratio.mcse <=
        ratio_of_means(summary.of(0, 1).metrics[1].moments, summary.of(0, 0).metrics[1].moments, 0.0).error);
}

TEST_CASE("the ratio of an uncertain mean is not trusted") {
  Summary summary = pair_summary();
  summary.statistics[0].metrics[0] =
      statistics_of(std::vector{-3.0, 3.1, -3.0, 3.1, -3.0, 3.1, -3.0, 3.1, -3.0, 3.1, -3.0, 3.1});
  CHECK_FALSE(row_of(summary_rows(with_ratios(summary)), 3, "error_m").trusted);
}

TEST_CASE("tables and CSV have ratios, figures draw them if they name them") {
  const Summary summary = pair_summary();
  CHECK(summary_table(summary).find("range_sigma_m = 0.5: rrr / rr\n") != std::string::npos);
  std::ostringstream csv;
  write_summary_csv(summary, csv);
  CHECK(csv.str().find("3,0.1,rrr / rr,error_m,1,20,1.5") != std::string::npos);

  FigureSpec spec;
  spec.name = "ratios";
  spec.x = "range_sigma_m";
  spec.y = {"error_all_m"};
  CHECK(figure_data(summary, spec).groups == std::vector<std::string>{"rr", "rrr"});
  spec.methods = {"rrr / rr"};
  const FigureData data = figure_data(summary, spec);
  CHECK(data.scales.at(0).label == "position error, all trials, ratio of the means");
  REQUIRE(data.panels[0].lines.size() == 1);
  CHECK(data.panels[0].lines[0].points.size() == 2);
  spec.methods = {"rrr - rr"};
  CHECK(figure_data(summary, spec).scales.at(0).label == "position error, all trials, mean [m]");

  const auto refusal = [&] { return tests::refusal_of([&] { figure_data(summary, spec); }); };
  spec.methods = {"rrr / rr", "rr"};
  CHECK(refusal() ==
        "figure 'ratios': methods: a ratio has no unit and stands beside ratios only; draw it in a figure of its own");
  spec.methods = {"rrr / rr"};
  spec.statistic = "median";
  CHECK(refusal() == "figure 'ratios': statistic: ratios are those of means; remove it");
}

}  // namespace
