#include "results/tables/overview.hpp"

#include <sstream>

#include "results/schema/text.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc::results;
using ridgeloc::tests::contains;

std::size_t widest_line(const std::string& text) {
  std::istringstream lines(text);
  std::size_t widest = 0;
  for (std::string line; std::getline(lines, line);) widest = std::max(widest, display_width(line));
  return widest;
}

/// The grid of `synthetic_summary`, with max_iterations a failure and a figure that leads with one metric and one
/// event.
Summary failing_summary() {
  Summary summary = synthetic_summary();
  summary.header.schema.events[1].is_failure = true;
  FigureSpec figure;
  figure.y = {"error_all_m", "converged"};
  summary.header.figures = {figure};
  return summary;
}

TEST_CASE("the overview leads with what the figures show, a heavy-tailed metric with its median") {
  const Summary summary = failing_summary();
  const std::string text = summary_overview(summary, whole(summary.header));
  INFO(text);
  CHECK(contains(text, "Errors, \"small\" and large\n"));
  CHECK(contains(text, "seed 2018"));
  CHECK(contains(text, "error_all_m [m]"));
  CHECK(contains(text, "median [95 %]"));
  CHECK(contains(text, "converged"));
  CHECK(contains(text, "0.80 [0.38, 0.96] !"));
  CHECK_FALSE(contains(text, "error_m [m]  "));
  CHECK(contains(text, "Failures, 4 cells together:\n"));
  CHECK(contains(text, "max_iterations 4"));
}

TEST_CASE("the marks of differences are told where there are any, whatever stands in names") {
  Summary summary = failing_summary();
  summary.header.methods[0].label = "sigma2 * n";
  CHECK_FALSE(contains(summary_overview(summary, whole(summary.header)), "excludes 0"));
}

TEST_CASE("a result whose parts are all there is not called one that lacks trials") {
  Summary summary = failing_summary();
  summary.is_sealed = false;
  const std::string text = summary_overview(summary, whole(summary.header));
  CHECK(contains(text, "incomplete: all trials are there, and the result has not been written from its parts"));
  CHECK_FALSE(contains(text, "0 of 4 cells"));
}

TEST_CASE("metrics, cells and methods of the overview can be chosen") {
  const Summary summary = failing_summary();
  SummaryChoice choice = whole(summary.header);
  choice.metrics = {"error_m"};
  choice.cells = {2, 3};
  choice.methods = methods_labelled(summary.header, {"rrr"});
  const std::string text = summary_overview(summary, choice);
  INFO(text);
  CHECK(contains(text, "shown: 2 of 4 cells, 1 of 2 methods\n"));
  CHECK(contains(text, "in every row: points = 5\n"));
  CHECK(contains(text, "1.25 ± 0.32 !"));
  CHECK_FALSE(contains(text, "error_all_m"));
  CHECK(contains(text, "Failures, 2 cells together:\n"));
}

TEST_CASE("the overview fits 100 columns, however long names and however many axes there are") {
  Summary summary = failing_summary();
  summary.header.methods[1].label = std::string(64, 'x');
  summary.header.axes[0].name = std::string(40, 'p');
  summary.header.axes[1].name = std::string(50, 's');
  summary.header.title = "A title of many words that goes on and on and on and on and on and on and on and on and on";
  const std::string text = summary_overview(summary, whole(summary.header));
  INFO(text);
  CHECK(widest_line(text) <= 100);
  CHECK(contains(text, std::string(64, 'x')));
}

TEST_CASE("a cell without trials is shown as such in the overview") {
  Summary summary = failing_summary();
  summary.statistics[0] = Statistics{};
  const std::string text = summary_overview(summary, whole(summary.header));
  INFO(text);
  CHECK(contains(text, "-"));
  CHECK(widest_line(text) <= 100);
}

}  // namespace
