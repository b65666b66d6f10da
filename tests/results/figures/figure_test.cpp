#include "results/figures/figure.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "results/figures/figure_data.hpp"
#include "results/figures/figure_script.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;
using ridgeloc::tests::infinity;
namespace fs = std::filesystem;

FigureSpec synthetic_spec() {
  FigureSpec spec;
  spec.name = "errors";
  spec.title = "Errors";
  spec.x = "points";
  spec.y = {"error_m"};
  spec.group = {"range_sigma_m"};
  spec.facet = "method";
  return spec;
}

std::string message_of(const FigureSpec& spec) {
  return tests::refusal_of([&] { figure_data(synthetic_summary(), spec); });
}

std::string content(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_CASE("a figure resolves into panels, groups and points with their intervals") {
  const Summary summary = synthetic_summary();
  const FigureData data = figure_data(summary, synthetic_spec());
  CHECK(data.x_label == "number of points");
  CHECK(data.scales.at(0).label == "position error, mean [m]");
  CHECK(data.group_title == "range noise [m]");
  CHECK(data.groups == std::vector<std::string>{"0.1", "0.5"});
  REQUIRE(data.panels.size() == 2);
  CHECK(data.panels[0].label == "rr");
  CHECK(data.panels[1].label == "rrr");
  REQUIRE(data.panels[1].lines.size() == 2);
  const FigureLine& line = data.panels[1].lines[0];
  REQUIRE(line.points.size() == 2);
  const SummaryRow row = summary_rows(summary)[5];
  CHECK(line.points[0].x == 3.0);
  CHECK(line.points[0].y == row.mean);
  CHECK(line.points[0].lo == row.lo);
  CHECK(line.points[0].hi == row.hi);
  CHECK_FALSE(line.points[0].trusted);
  CHECK(data.footnote ==
        "4 trials per point (80 % or more of those that were run); bars: 95 % intervals; points share trials and are "
        "not independent; dotted bars: "
        "the interval "
        "itself is uncertain");
}

TEST_CASE("a heavy-tailed metric leads with its median; the statistic can be chosen") {
  FigureSpec spec = synthetic_spec();
  spec.y = {"error_all_m"};
  const FigureData data = figure_data(synthetic_summary(), spec);
  const SummaryRow row = summary_rows(synthetic_summary())[1];
  CHECK(data.scales.at(0).label == "position error, all trials, median [m]");
  CHECK(data.panels[0].lines[0].points[0].y == row.p50);
  CHECK(std::isnan(data.panels[0].lines[0].points[0].hi));  // five values are too few for an interval
  spec.statistic = "mean";
  CHECK(figure_data(synthetic_summary(), spec).panels[0].lines[0].points[0].y == row.mean);
}

TEST_CASE("methods become groups where nothing else tells them apart") {
  FigureSpec spec = synthetic_spec();
  spec.facet = "";
  CHECK(figure_data(synthetic_summary(), spec).groups ==
        std::vector<std::string>{"range_sigma_m = 0.1, rr", "range_sigma_m = 0.1, rrr", "range_sigma_m = 0.5, rr",
                                 "range_sigma_m = 0.5, rrr"});
  spec.methods = {"rrr"};
  CHECK(figure_data(synthetic_summary(), spec).groups == std::vector<std::string>{"0.1", "0.5"});
}

TEST_CASE("several metrics share a label and get legend texts") {
  FigureSpec spec = synthetic_spec();
  spec.y = {"error_m", "error_all_m"};
  spec.statistic = "median";
  const FigureData data = figure_data(synthetic_summary(), spec);
  CHECK(data.scales.at(0).label == "median [m]");
  CHECK(data.metrics == std::vector<std::string>{"position error", "position error, all trials"});
  CHECK(data.panels[0].lines.size() == 4);
  spec.y = {"error_m", "converged", "error_all_m"};
  CHECK(figure_data(synthetic_summary(), spec).metrics ==
        std::vector<std::string>{"position error, median [m]", "converged, rate",
                                 "position error, all trials, median [m]"});
}

TEST_CASE("an error and the rate at which it is one stand beside each other, each with an axis of its own") {
  FigureSpec spec = synthetic_spec();
  spec.y = {"error_m", "converged"};
  spec.log_y = true;
  const FigureData data = figure_data(synthetic_summary(), spec);
  REQUIRE(data.scales.size() == 2);
  CHECK(data.scales[0].label == "position error, mean [m]");
  CHECK(data.scales[0].log);
  CHECK(data.scales[1].label == "converged, rate");
  CHECK_FALSE(data.scales[1].log);
  CHECK(data.metrics == std::vector<std::string>{""});
  REQUIRE(data.panels.size() == 4);
  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(data.panels[i].label == (i < 2 ? "rr" : "rrr"));
    CHECK(data.panels[i].scale == i % 2);
    CHECK(data.panels[i].lines.size() == 2);
  }
  CHECK(data.panels[1].lines[0].points[0].y == 0.8);
}

TEST_CASE("a quantile is drawn with its interval from order statistics") {
  Summary summary = synthetic_summary();
  std::vector<double> values;
  for (int i = 1; i <= 1000; ++i) values.push_back(i / 100.0);
  for (Statistics& statistics : summary.statistics) statistics.metrics[0] = statistics_of(values);
  FigureSpec spec = synthetic_spec();
  spec.statistic = "p95";
  const FigureData data = figure_data(summary, spec);
  const SummaryRow row = summary_rows(summary)[0];
  const FigurePoint point = data.panels[0].lines[0].points[0];
  CHECK(data.scales.at(0).label == "position error, 95 % quantile [m]");
  CHECK(point.y == row.p95);
  CHECK(point.lo == row.p95_lo);
  CHECK(point.hi == row.p95_hi);
  CHECK(point.trusted);
  spec.statistic = "p99";
  CHECK(figure_data(summary, spec).panels[0].lines[0].points[0].y == Approx(9.9).epsilon(0.01));
  for (Statistics& statistics : summary.statistics) statistics.metrics[0] = statistics_of(std::vector{-1.0, 1.0});
  CHECK(figure_data(summary, spec).panels[0].lines[0].points.empty());
}

TEST_CASE("a rate of which nothing was seen knows its upper bound") {
  Summary summary = synthetic_summary();
  for (Statistics& statistics : summary.statistics) statistics = {300, {300, 0, 300}, statistics.metrics};
  FigureSpec spec = synthetic_spec();
  spec.y = {"max_iterations"};
  const FigurePoint none = figure_data(summary, spec).panels[0].lines[0].points[0];
  CHECK(none.never_seen);
  CHECK(none.y == 0.0);
  CHECK(none.hi == 0.01);
  spec.y = {"converged"};
  CHECK_FALSE(figure_data(summary, spec).panels[0].lines[0].points[0].never_seen);
}

TEST_CASE("more lines than can be told apart are refused with what to do") {
  Summary summary = synthetic_summary();
  Header& header = summary.header;
  for (int i = 0; i < 10; ++i) {
    header.axes[1].values.emplace_back(1.0 + i);
    header.cells.push_back({"cell", {0, static_cast<std::size_t>(i + 2)}});
    summary.statistics.insert(summary.statistics.end(), {five_trials(1.0), five_trials(1.0)});
  }
  FigureSpec spec = synthetic_spec();
  spec.group = {"range_sigma_m", "method"};
  spec.facet.clear();
  CHECK(figure_data(summary, spec).panels[0].lines.size() == 24);
  header.methods.push_back({"lm", "h3", ""});
  header.methods.push_back({"ols", "h4", ""});
  const std::vector<Statistics> two = summary.statistics;
  summary.statistics.clear();
  for (std::size_t i = 0; i < two.size(); i += 2)
    summary.statistics.insert(summary.statistics.end(), {two[i], two[i + 1], two[i], two[i + 1]});
  const std::string message = tests::refusal_of([&] { figure_data(summary, spec); });
  CHECK(message.find("48 lines in one panel cannot be told apart (at most 30)") != std::string::npos);
  CHECK(message.find("range_sigma_m, method a panel for each value (facet)") != std::string::npos);
  spec.group = {"range_sigma_m"};
  spec.facet = "method";
  CHECK(figure_data(summary, spec).panels.size() == 4);
}

TEST_CASE("a logarithmic axis is refused to what is not above zero") {
  Summary summary = synthetic_summary();
  CHECK(figure_data(summary, synthetic_spec(), {.log_x = true}).log_x);
  summary.header.axes[0].values[0] = std::int64_t{0};
  const std::string message = tests::refusal_of([&] { figure_data(summary, synthetic_spec(), {.log_x = true}); });
  CHECK(message == "figure 'errors': --log-x needs an axis of numbers above 0, and points is none");
}

TEST_CASE("an axis of texts is drawn as categories, one that spans decades logarithmically") {
  Summary summary = synthetic_summary();
  summary.header.axes[0].values = {std::string("street"), std::string("hall")};
  const FigureData categories = figure_data(summary, synthetic_spec());
  REQUIRE(categories.x_ticks.size() == 2);
  CHECK(categories.x_ticks[1].position == 1.0);
  CHECK(categories.x_ticks[1].label == "hall");
  CHECK_FALSE(categories.log_x);
  CHECK(categories.is_categorical);
  CHECK_FALSE(figure_data(synthetic_summary(), synthetic_spec()).is_categorical);
  summary.header.axes[0].values = {0.01, 0.1, 1.0};
  CHECK(figure_data(summary, synthetic_spec()).log_x);
}

TEST_CASE("points of a category stand beside each other and no line joins them") {
  Summary summary = synthetic_summary();
  const auto script_of = [&] {
    return figure_script(figure_data(summary, synthetic_spec()), FigureFormat::Svg, "figure.svg");
  };
  CHECK(script_of().find("$panel0_group0_metric0 using 1:2 with lines") != std::string::npos);
  summary.header.axes[0].values = {std::string("street"), std::string("hall")};
  CHECK(script_of().find(" using 1:2 with lines") == std::string::npos);
  const FigureData data = figure_data(summary, synthetic_spec());
  const auto& lines = data.panels.at(0).lines;
  REQUIRE(lines.size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    const auto category = static_cast<double>(i);
    CHECK(lines[0].points[i].x < category);
    CHECK(category < lines[1].points[i].x);
    CHECK(lines[1].points[i].x - lines[0].points[i].x == Approx(0.3));
  }
}

TEST_CASE("categories that are not drawn take no room") {
  Summary summary = synthetic_summary();
  summary.header.axes[0].values = {std::string("street"), std::string("hall")};
  FigureSpec spec = synthetic_spec();
  spec.where = {{"points", {"hall"}}};
  const FigureData data = figure_data(summary, spec);
  REQUIRE(data.x_ticks.size() == 1);
  CHECK(data.x_ticks[0].position == 0.0);
  CHECK(data.x_ticks[0].label == "hall");
  for (const FigureLine& line : data.panels.at(0).lines) CHECK(std::abs(line.points.at(0).x) < 0.5);
}

/// The synthetic summary with an axis that moves along with another one.
Summary zipped_summary(std::size_t with) {
  Summary summary = synthetic_summary();
  Header& header = summary.header;
  header.axes.push_back({"start_offset_m", "m", "distance of the start", {1.0, 5.0}});
  for (CellInfo& cell : header.cells) cell.indices.push_back(cell.indices[with]);
  return summary;
}

TEST_CASE("an axis that moves along with one of the figure stands beside it") {
  const FigureData with_x = figure_data(zipped_summary(0), synthetic_spec());
  CHECK(with_x.x_label == "number of points (distance of the start [m])");
  CHECK(with_x.x_ticks.at(1).label == "5 (5)");
  CHECK(with_x.groups == std::vector<std::string>{"0.1", "0.5"});
  CHECK(with_x.conditions.empty());

  const FigureData with_group = figure_data(zipped_summary(1), synthetic_spec());
  CHECK(with_group.x_ticks.at(1).label == "5");
  CHECK(with_group.group_title == "range noise [m] (distance of the start [m])");
  CHECK(with_group.groups == std::vector<std::string>{"0.1 (1)", "0.5 (5)"});
  FigureSpec spec = synthetic_spec();
  spec.facet.clear();
  CHECK(figure_data(zipped_summary(1), spec).groups.at(0) == "range_sigma_m = 0.1, start_offset_m = 1, rr");

  Summary empty = zipped_summary(1);
  empty.header.axes[1].values = {std::string(), std::string("sigma2 / p")};
  CHECK(figure_data(empty, synthetic_spec()).groups == std::vector<std::string>{"1", "sigma2 / p (5)"});
  Summary alone = synthetic_summary();
  alone.header.axes[1].values = empty.header.axes[1].values;
  CHECK(figure_data(alone, synthetic_spec()).groups.front() == "none");

  Summary by_both = zipped_summary(0);
  for (CellInfo& cell : by_both.header.cells) cell.indices[2] = (cell.indices[0] + cell.indices[1]) % 2;
  CHECK(figure_data(by_both, synthetic_spec()).conditions == "start_offset_m differs from cell to cell");
}

TEST_CASE("a legend keeps the order of the axis where the first cell is left out") {
  Summary summary = synthetic_summary();
  summary.header.cells.erase(summary.header.cells.begin());
  summary.statistics.erase(summary.statistics.begin(), summary.statistics.begin() + 2);
  const FigureData data = figure_data(summary, synthetic_spec());
  CHECK(data.groups == std::vector<std::string>{"0.1", "0.5"});
  const auto& lines = data.panels.at(0).lines;
  CHECK(lines.size() == 2);
  for (const FigureLine& line : lines) CHECK(line.points.size() == (line.group == 0 ? 1 : 2));
}

TEST_CASE("unknown names are refused with the nearest valid ones") {
  const auto with = [](auto change) {
    FigureSpec spec = synthetic_spec();
    change(spec);
    return message_of(spec);
  };
  CHECK(with([](FigureSpec& s) { s.x = "point"; }) ==
        "figure 'errors': x = \"point\" is unknown; valid names: points, range_sigma_m");
  CHECK(with([](FigureSpec& s) { s.y = {"error"}; }).find("y = \"error\" is unknown; valid names: error_m, ") !=
        std::string::npos);
  CHECK(with([](FigureSpec& s) { s.group = {"methods"}; }).find("valid names: method, ") != std::string::npos);
  CHECK(with([](FigureSpec& s) { s.facet = "range_sigma"; }).find("valid names: range_sigma_m, ") != std::string::npos);
  CHECK(with([](FigureSpec& s) { s.methods = {"rrrr"}; }).find("valid names: rrr, rr") != std::string::npos);
  CHECK(with([](FigureSpec& s) { s.statistic = "meen"; }).find("valid names: mean, median, rms") != std::string::npos);
  CHECK(with([](FigureSpec& s) { s.y.clear(); }) == "figure 'errors': y names no metric");
}

TEST_CASE("cells that would fall on one point are refused with the axis to add") {
  FigureSpec spec = synthetic_spec();
  spec.group.clear();
  CHECK(message_of(spec) ==
        "figure 'errors': several cells fall on one point, among them points = 3, range_sigma_m = 0.5; add "
        "to group or "
        "facet: range_sigma_m");
}

TEST_CASE("a metric that no method reports cannot be drawn") {
  Summary summary = synthetic_summary();
  for (Statistics& statistics : summary.statistics) statistics.metrics[0] = MetricStatistics{};
  CHECK_THROWS_AS(figure_data(summary, synthetic_spec()), core::InputError);
}

TEST_CASE("figures are drawn in all three formats and leave nothing else behind") {
  const tests::ScratchFolder folder;
  FigureSpec spec = synthetic_spec();
  spec.title = "it's 100% \"odd\": `touch x` $(y) \\n {a}_b^c @d # e";
  spec.log_y = GENERATE(false, true);
  const struct {
    const char* extension;
    const char* magic;
  } formats[] = {{".svg", "<?xml"}, {".pdf", "%PDF"}, {".png", "\x89PNG"}};
  for (const auto& format : formats) {
    draw_figure(synthetic_summary(), spec, folder / (std::string("figure") + format.extension));
    CHECK(content(folder / (std::string("figure") + format.extension)).find(format.magic) == 0);
  }
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 3);
  const std::string svg = content(folder / "figure.svg");
  CHECK(svg.find("`touch x` $(y) \\n {a}_b^c @d # e") != std::string::npos);
  CHECK(svg.find("range noise [m]") != std::string::npos);
}

/// The texts of an SVG, one after the other.
std::string texts_of(const std::string& svg) {
  std::string text;
  for (std::size_t at = svg.find("<text>"); at != std::string::npos; at = svg.find("<text>", at + 1))
    text += svg.substr(at, svg.find("</text>", at) - at) + "\n";
  const std::pair<const char*, const char*> entities[] = {{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}};
  for (const auto& [entity, character] : entities) {
    for (std::size_t at = text.find(entity); at != std::string::npos; at = text.find(entity, at + 1))
      text.replace(at, std::string(entity).size(), character);
  }
  return text;
}

TEST_CASE("every printable character is drawn as it is at every place, at the beginning, within and at the end") {
  const tests::ScratchFolder folder;
  Summary summary = synthetic_summary();
  Header& header = summary.header;
  std::string all;
  for (char c = '!'; c <= '~'; ++c) all += c;
  const std::string texts[] = {
      "'Robust' methods", "\"a", "a\"", "`date`", "@x", "#c", "100 %", all, "\\", "a\\n", "größe"};
  for (const std::string& text : texts) {
    INFO(text);
    header.axes[0].values = {text, std::string("other")};
    header.axes[0].description = "axis" + text;
    header.axes[1].description = text + "legend";
    header.methods[0].label = text + "panel";
    header.schema.metrics[0].description = "y" + text;
    FigureSpec spec = synthetic_spec();
    spec.title = "title" + text;
    draw_figure(summary, spec, folder / "it's `a` \"$(b)\".svg");
    const std::string drawn = texts_of(content(folder / "it's `a` \"$(b)\".svg"));
    for (const std::string& expected : {">" + text + "\n", "axis" + text, text + "legend", text + "panel"})
      CHECK(drawn.find(expected.substr(expected.front() == '>' ? 1 : 0)) != std::string::npos);
    if (text != all) CHECK(drawn.find("title" + text) != std::string::npos);
    if (text != all) CHECK(drawn.find("y" + text) != std::string::npos);
  }
}

TEST_CASE("an SVG says what it shows and of which data") {
  const tests::ScratchFolder folder;
  FigureSpec spec = synthetic_spec();
  spec.title = "Errors <&>";
  draw_figure(synthetic_summary(), spec, folder / "figure.svg", {}, "0123abcd");
  const std::string svg = content(folder / "figure.svg");
  CHECK(svg.find("<title>Errors &lt;&amp;&gt;</title>") != std::string::npos);
  CHECK(svg.find("<desc>position error, mean [m] against number of points") != std::string::npos);
  CHECK(svg.find("Data: SHA-256 0123abcd</desc>") != std::string::npos);
}

TEST_CASE("values at the ends of what a double holds are drawn") {
  const tests::ScratchFolder folder;
  Summary summary = synthetic_summary();
  summary.header.axes[0].values = {1e-300, 1e300};
  const double tiny = GENERATE(1e-300, 3e-310);
  for (Statistics& statistics : summary.statistics)
    statistics.metrics[0] = statistics_of(std::vector{tiny, 2 * tiny, 3 * tiny});
  FigureSpec spec = synthetic_spec();
  spec.log_y = GENERATE(false, true);
  const FigureView view{.log_x = GENERATE(false, true)};
  CHECK_NOTHROW(draw_figure(summary, spec, folder / "figure.svg", view));
}

TEST_CASE("distributions are drawn, with logarithmic shares too") {
  const tests::ScratchFolder folder;
  FigureSpec spec = synthetic_spec();
  spec.x.clear();
  spec.group = {"points", "range_sigma_m"};
  spec.kind = GENERATE("ecdf", "histogram");
  spec.methods = {"rr"};
  spec.log_y = GENERATE(false, true);
  draw_figure(synthetic_summary(), spec, folder / "figure.svg");
  CHECK(content(folder / "figure.svg").find("share of the values") != std::string::npos);
}

TEST_CASE("a figure whose points are all infinite still shows its axes") {
  const tests::ScratchFolder folder;
  Summary summary = synthetic_summary();
  for (Statistics& statistics : summary.statistics)
    statistics.metrics[1] = statistics_of(std::vector{infinity, infinity});
  FigureSpec spec = synthetic_spec();
  spec.y = {"error_all_m"};
  draw_figure(summary, spec, folder / "axes.svg");
  CHECK(content(folder / "axes.svg").find("infinite") != std::string::npos);
}

TEST_CASE("an unknown file extension is refused") {
  CHECK_THROWS_AS(draw_figure(synthetic_summary(), synthetic_spec(), "figure.jpg"), core::InputError);
}

}  // namespace
