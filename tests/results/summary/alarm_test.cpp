// Metrics that are yes or no: their rates, their lines in tables, and what figures say of alarms.

#include "results/summary/alarm.hpp"

#include <cmath>

#include "results/figures/figure_data.hpp"
#include "results/statistics/interval.hpp"
#include "results/tables/table.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace ridgeloc::results {
namespace {

/// A third metric, yes or no, tried on `trials` trials of every cell and method, of which `yes` say yes.
Summary with_alarm(std::size_t trials, std::size_t yes) {
  Summary summary = synthetic_summary();
  summary.header.schema.metrics.push_back({"disagrees", "1", "wrong", false, false, true, "checked by hand"});
  std::vector<double> values(trials, 0.0);
  for (std::size_t i = 0; i < yes; ++i) values[i] = 1.0;
  values.push_back(std::nan(""));
  for (Statistics& statistics : summary.statistics) statistics.metrics.push_back(statistics_of(values));
  return summary;
}

FigureSpec errors_over_points(std::vector<std::string> methods) {
  FigureSpec spec;
  spec.name = "errors";
  spec.x = "points";
  spec.y = {"error_m"};
  spec.group = {"range_sigma_m"};
  spec.facet = "method";
  spec.methods = std::move(methods);
  return spec;
}

TEST_CASE("a yes-or-no metric is a rate with Wilson's interval") {
  const auto rows = summary_rows(with_alarm(40, 3));
  const SummaryRow& row = rows[2];
  REQUIRE(row.metric == "disagrees");
  CHECK(row.n == 40);
  CHECK(row.mean == 3.0 / 40.0);
  CHECK(row.lo == wilson_interval(3, 40).lo);
  CHECK(row.hi == wilson_interval(3, 40).hi);
  CHECK(std::isnan(row.p50));
  CHECK(std::isnan(row.sd));
  CHECK_FALSE(row.trusted);
}

TEST_CASE("tables bound what was not seen by 3 / n") {
  CHECK(upper_bound_of_none(300) == 0.01);
  CHECK(upper_bound_of_none(2) == 1.0);
  CHECK(std::isnan(upper_bound_of_none(0)));
  const std::string none = summary_table(with_alarm(300, 0));
  CHECK(none.find("  disagrees        300  0 [<= 0.01]          0\n") != std::string::npos);
  CHECK(none.find("0 [<= u]: not seen once") != std::string::npos);
  CHECK(summary_table(with_alarm(300, 30)).find("  disagrees        300  0.100 [0.071, 0.139]  30\n") !=
        std::string::npos);
}

TEST_CASE("figures say how often an alarm rang where they look") {
  // Two of four cells and methods of 100 trials each, then all eight.
  const auto footnote = [](const Summary& summary, std::vector<std::string> methods) {
    return figure_data(summary, errors_over_points(std::move(methods))).footnote;
  };
  CHECK(footnote(with_alarm(100, 0), {"rr"}).ends_with("; checked by hand: 400 checks, disagreements 0 (<= 0.75 %)"));
  CHECK(footnote(with_alarm(100, 0), {"rr", "rrr"}).ends_with(": 800 checks, disagreements 0 (<= 0.38 %)"));
  // Wilson's upper end of 8 in 800: 1.96 %.
  CHECK(footnote(with_alarm(100, 1), {"rr", "rrr"}).ends_with(": 800 checks, disagreements 8 (<= 2 %)"));
  CHECK(footnote(with_alarm(0, 0), {"rr"}).find("checked") == std::string::npos);
  CHECK(footnote(synthetic_summary(), {"rr"}).find("checked") == std::string::npos);
}

}  // namespace
}  // namespace ridgeloc::results
