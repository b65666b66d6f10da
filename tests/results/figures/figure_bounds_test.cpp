#include "results/figures/figure_bounds.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "results/figures/figure.hpp"
#include "results/figures/figure_data.hpp"
#include "results/statistics/interval.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;

/// The synthetic summary, whose errors have a bound of 0.1 to 0.9 m times the noise, reported by a label of its own.
/// Its mean square is finite for 5 points only.
Summary bounded_summary() {
  const Summary bare = synthetic_summary();
  Summary summary{bare.header, {}};
  Header& header = summary.header;
  header.schema.metrics.push_back({"crb_m", "m", "smallest error", true});
  for (std::size_t m = 0; m < 2; ++m) header.schema.metrics[m].bound = "crb_m";
  header.methods.push_back({"scene", "h3", ""});
  for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
    const auto& indices = header.cells[cell].indices;
    header.cells[cell].bound = indices[0] == 0 ? BoundKind::Quantiles : BoundKind::RootMeanSquare;
    for (std::size_t method = 0; method < 2; ++method) {
      summary.statistics.push_back(bare.of(cell, method));
      summary.statistics.back().metrics.emplace_back();
    }
    const double sigma = indices[1] == 0 ? 0.1 : 0.5;
    std::vector<double> values;
    for (int i = 1; i <= 9; ++i) values.push_back(sigma * i / 10.0);
    Statistics scene;
    scene.trials = values.size();
    scene.metrics = {MetricStatistics{}, MetricStatistics{}, statistics_of(values)};
    summary.statistics.push_back(scene);
  }
  return summary;
}

FigureSpec error_figure() {
  FigureSpec spec;
  spec.name = "errors";
  spec.x = "points";
  spec.y = {"error_m"};
  spec.group = {"range_sigma_m"};
  spec.facet = "method";
  return spec;
}

/// Of the one bound of a panel with the same entry and group.
const FigureBound& bound_of(const FigureData& data, const std::string& text, std::size_t group) {
  for (const FigureBound& bound : data.panels.at(0).bounds)
    if (data.bounds[bound.entry] == text && bound.group == group) return bound;
  throw std::runtime_error("no bound " + text);
}

TEST_CASE("errors are drawn with the median and the quartiles of their bound, in the colour of its group") {
  const Summary summary = bounded_summary();
  const FigureData data = figure_data(summary, error_figure());
  CHECK(data.bounds == std::vector<std::string>{"bound of unbiased estimates, median and quartiles"});
  REQUIRE(data.panels.size() == 2);
  for (const FigurePanel& panel : data.panels) CHECK(panel.bounds.size() == 2);
  const FigureBound& bound = bound_of(data, "bound of unbiased estimates, median and quartiles", 1);
  CHECK(bound.has_band);
  REQUIRE(bound.points.size() == 2);
  const SummaryRow row = summary_row(summary.header, 2, summary.of(1, 2), "crb_m");
  CHECK(bound.points[0].x == 3.0);
  CHECK(bound.points[0].y == row.p50);
  CHECK(bound.points[0].lo == row.p25);
  CHECK(bound.points[0].hi == row.p75);
  CHECK(data.footnote.find("; bound of unbiased estimates, of their root mean squares: smallest error") !=
        std::string::npos);
}

TEST_CASE("root mean squares have that of the bound where it is finite, and the quartiles elsewhere") {
  FigureSpec spec = error_figure();
  spec.statistic = "rms";
  const FigureData data = figure_data(bounded_summary(), spec);
  CHECK(data.bounds == std::vector<std::string>{"bound of unbiased estimates, median and quartiles",
                                                "bound of unbiased estimates, root mean square"});
  const FigureBound& quartiles = bound_of(data, "bound of unbiased estimates, median and quartiles", 0);
  REQUIRE(quartiles.points.size() == 1);
  CHECK(quartiles.points[0].x == 3.0);
  const FigureBound& rms = bound_of(data, "bound of unbiased estimates, root mean square", 0);
  CHECK_FALSE(rms.has_band);
  REQUIRE(rms.points.size() == 1);
  CHECK(rms.points[0].x == 5.0);
  CHECK(rms.points[0].y == Approx(0.1 * std::sqrt(285.0 / 9.0) / 10.0));
}

TEST_CASE("a bound that several groups share is drawn once, in grey") {
  FigureSpec spec = error_figure();
  spec.group = {"method"};
  spec.facet = "range_sigma_m";
  const FigureData alone = figure_data(bounded_summary(), spec);
  for (const FigurePanel& panel : alone.panels) {
    REQUIRE(panel.bounds.size() == 1);
    CHECK_FALSE(panel.bounds[0].group);
  }
  spec.group = {"method", "range_sigma_m"};
  spec.facet.clear();
  const FigureData both = figure_data(bounded_summary(), spec);
  CHECK(both.panels.at(0).bounds.size() == 2);
  CHECK(both.bounds ==
        std::vector<std::string>{"bound of unbiased estimates, median and quartiles (range_sigma_m = 0.1)",
                                 "bound of unbiased estimates, median and quartiles (range_sigma_m = 0.5)"});
}

TEST_CASE(
    "groups that differ in what a bound does not depend on share it, and the legend says what they have in common") {
  // Each cell twice, with two formulas of K: the bound is that of the scene.
  const Summary bounded = bounded_summary();
  Summary summary{bounded.header, {}};
  Header& header = summary.header;
  header.axes.push_back({"k_expr", "1", "", {std::string("n"), std::string("p")}});
  header.cells.clear();
  for (std::size_t cell = 0; cell < bounded.header.cells.size(); ++cell) {
    for (std::size_t k = 0; k < 2; ++k) {
      header.cells.push_back(bounded.header.cells[cell]);
      header.cells.back().indices.push_back(k);
      for (std::size_t method = 0; method < 3; ++method) summary.statistics.push_back(bounded.of(cell, method));
    }
  }
  FigureSpec spec = error_figure();
  spec.group = {"k_expr"};
  spec.where = {{"range_sigma_m", {"0.5"}}};
  const FigureData one = figure_data(summary, spec);
  for (const FigurePanel& panel : one.panels) {
    REQUIRE(panel.bounds.size() == 1);
    CHECK_FALSE(panel.bounds[0].group);
  }
  CHECK(one.bounds == std::vector<std::string>{"bound of unbiased estimates, median and quartiles"});

  spec.group = {"range_sigma_m", "k_expr"};
  spec.where.clear();
  const FigureData two = figure_data(summary, spec);
  CHECK(two.panels.at(0).bounds.size() == 2);
  CHECK(two.bounds ==
        std::vector<std::string>{"bound of unbiased estimates, median and quartiles (range_sigma_m = 0.1)",
                                 "bound of unbiased estimates, median and quartiles (range_sigma_m = 0.5)"});
}

TEST_CASE("no bound is drawn where there is none, where it is drawn already, and where it is not wanted") {
  const auto bounds = [](const Summary& summary, const FigureSpec& spec) {
    return figure_data(summary, spec).bounds.size();
  };
  FigureSpec spec = error_figure();
  Summary summary = bounded_summary();
  CHECK(bounds(summary, spec) == 1);
  for (CellInfo& cell : summary.header.cells) cell.bound = BoundKind::None;
  CHECK(bounds(summary, spec) == 0);
  spec.y = {"converged"};
  CHECK(bounds(bounded_summary(), spec) == 0);
  spec.y = {"error_m", "crb_m"};
  spec.group = {"range_sigma_m", "method"};
  spec.facet.clear();
  CHECK(bounds(bounded_summary(), spec) == 0);
  spec = error_figure();
  spec.bounds = false;
  CHECK(bounds(bounded_summary(), spec) == 0);
  summary = bounded_summary();
  summary.header.methods[1].difference = {1, 0};
  spec = error_figure();
  spec.methods = {"rrr"};
  CHECK(bounds(summary, spec) == 0);
}

TEST_CASE("more than three bands in a panel become lines") {
  Summary summary = bounded_summary();
  Header& header = summary.header;
  header.axes[1].values = {0.1, 0.5, 0.7, 0.9};
  const Summary two = summary;
  for (std::size_t cell = 0; cell < 4; ++cell) {
    header.cells.push_back(header.cells[cell]);
    header.cells.back().indices[1] += 2;
    for (std::size_t method = 0; method < 3; ++method) summary.statistics.push_back(two.of(cell, method));
    // Equal bounds would be one.
    const double level = 1.0 + static_cast<double>(cell);
    summary.statistics.back().metrics[2] = statistics_of(std::vector{level, 2.0 * level, 3.0 * level});
  }
  const FigureData data = figure_data(summary, error_figure());
  CHECK(data.bounds == std::vector<std::string>{"bound of unbiased estimates, median"});
  for (const FigureBound& bound : data.panels[0].bounds) CHECK_FALSE(bound.has_band);
}

TEST_CASE("means of what is chi-square in theory have the expected value and its band, that of the fewest values") {
  Summary summary = bounded_summary();
  summary.header.schema.metrics[0].chi_square = 3;
  for (CellInfo& cell : summary.header.cells) cell.bound = BoundKind::None;
  summary.statistics[0].metrics[0] = statistics_of(std::vector{1.0, 2.0});
  FigureSpec spec = error_figure();
  const FigureData data = figure_data(summary, spec);
  CHECK(data.bounds == std::vector<std::string>{"expected, with 95 % of the means"});
  REQUIRE(data.panels[0].bounds.size() == 1);
  const FigureBound& bound = data.panels[0].bounds[0];
  CHECK_FALSE(bound.group);
  CHECK(bound.has_band);
  REQUIRE(bound.points.size() == 2);
  CHECK(bound.points[0].y == 3.0);
  CHECK(bound.points[0].hi == chi_square_mean_range(2, 3).hi);
  CHECK(bound.points[1].lo == chi_square_mean_range(4, 3).lo);
  CHECK(data.footnote.find("; expected: chi-square with 3 degrees of freedom") != std::string::npos);
  spec.statistic = "median";
  CHECK(figure_data(summary, spec).bounds.empty());
}

TEST_CASE("what all cells of a figure share stands under its title") {
  FigureSpec spec = error_figure();
  spec.group = {"method"};
  spec.facet.clear();
  spec.where = {{"range_sigma_m", {"0.5"}}};
  CHECK(figure_data(bounded_summary(), spec).conditions == "range_sigma_m = 0.5");
  spec = error_figure();
  spec.where = {{"range_sigma_m", {"0.5"}}};
  CHECK(figure_data(bounded_summary(), spec).conditions.empty());
}

TEST_CASE("bounds and conditions are drawn") {
  const tests::ScratchFolder folder;
  FigureSpec spec = error_figure();
  spec.statistic = GENERATE("", "rms");
  spec.log_y = GENERATE(false, true);
  spec.facet.clear();
  spec.group = {"method"};
  spec.where = {{"range_sigma_m", {"0.5"}}};
  draw_figure(bounded_summary(), spec, folder / "figure.svg");
  std::ifstream in(folder / "figure.svg");
  const std::string svg{std::istreambuf_iterator<char>(in), {}};
  CHECK(svg.find("bound of unbiased estimates, median and quartiles") != std::string::npos);
  CHECK(svg.find("range_sigma_m = 0.5") != std::string::npos);
}

}  // namespace
