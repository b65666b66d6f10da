#include "results/figures/figure_distribution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "results/figures/figure_data.hpp"
#include "results/statistics/interval.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;
using Kind = FigureNames::Kind;
using tests::infinity;

Histogram histogram_of(const std::vector<double>& values) {
  Histogram histogram;
  histogram.add(values);
  return histogram;
}

std::vector<double> exponential_values(std::size_t n) {
  std::mt19937_64 engine(1);
  std::exponential_distribution<double> draw;
  std::vector<double> values(n);
  for (double& value : values) value = draw(engine);
  return values;
}

/// y of the line at a place, linear between its points.
double height_at(const std::vector<FigurePoint>& points, double x) {
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (x < points[i - 1].x || x > points[i].x || points[i].x == points[i - 1].x) continue;
    const double share = (x - points[i - 1].x) / (points[i].x - points[i - 1].x);
    return points[i - 1].y + share * (points[i].y - points[i - 1].y);
  }
  return std::numeric_limits<double>::quiet_NaN();
}

TEST_CASE("an ECDF is the share of the values up to each place") {
  const std::vector<double> values = exponential_values(20000);
  const Histogram histogram = histogram_of(values);
  const FigureDistribution distribution(Kind::Ecdf, false, {&histogram});
  const auto points = distribution.points(histogram);
  for (const double x : {0.01, 0.1, 0.5, 1.0, 3.0}) {
    const auto below = std::ranges::count_if(values, [&](double v) { return v <= x; });
    // Linear within a bin of 1/32: the density there is at most 1, and x / 32 wide.
    CHECK(std::abs(height_at(points, x) - static_cast<double>(below) / 20000.0) < x / 32.0 * 0.2 + 2e-4);
  }
  CHECK(points.front().x == distribution.ticks().front().position);
  CHECK(points.back().x == distribution.ticks().back().position);
  CHECK(points.back().y > 0.999);
  CHECK(std::ranges::is_sorted(points, {}, &FigurePoint::y));
  for (const FigurePoint& point : points) {
    const Interval interval = wilson_interval(static_cast<std::uint64_t>(std::llround(point.y * 20000.0)), 20000);
    CHECK(point.lo == interval.lo);
    CHECK(point.hi == interval.hi);
  }
}

TEST_CASE("infinite values belong to the population, so that the ECDF ends below 1") {
  const Histogram histogram = histogram_of({1.0, 2.0, 3.0, infinity});
  const FigureDistribution distribution(Kind::Ecdf, false, {&histogram});
  CHECK(distribution.points(histogram).back().y == 0.75);
  CHECK(distribution.share_outside(histogram) == 0.25);
}

TEST_CASE("the ECDF of whole numbers steps at these") {
  const Histogram histogram = histogram_of({3.0, 3.0, 4.0, 7.0});
  const auto points = FigureDistribution(Kind::Ecdf, true, {&histogram}).points(histogram);
  CHECK(height_at(points, 2.99) == 0.0);
  CHECK(height_at(points, 3.01) == 0.5);
  CHECK(height_at(points, 6.99) == 0.75);
  CHECK(height_at(points, 7.01) == 1.0);
}

TEST_CASE("a histogram encloses all values on the axis") {
  const Histogram histogram = histogram_of(exponential_values(20000));
  const FigureDistribution distribution(Kind::Histogram, false, {&histogram});
  const auto points = distribution.points(histogram);
  double area = 0.0;
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].y == points[i - 1].y) area += points[i].y * std::log2(points[i].x / points[i - 1].x);
  }
  CHECK(std::abs(area + distribution.share_outside(histogram) - 1.0) < 1e-3);  // bins that the axis cuts
  CHECK(distribution.share_outside(histogram) < 2e-3);
  CHECK(points.size() < 2 * 60);  // by Rice's rule 2 * 20000^(1/3) = 54 bins of the values, fewer outside
}

TEST_CASE("a histogram of whole numbers has the share of each") {
  const Histogram histogram = histogram_of({1.0, 3.0, 3.0, 4.0});
  const FigureDistribution distribution(Kind::Histogram, true, {&histogram});
  const auto points = distribution.points(histogram);
  CHECK(height_at(points, 0.9) == 0.25);
  CHECK(height_at(points, 2.0) == 0.0);
  CHECK(height_at(points, 3.1) == 0.5);
  CHECK(height_at(points, 4.1) == 0.25);
  CHECK(distribution.ticks().front().position == 0.5);
}

TEST_CASE("ticks stand at 1, 2 and 5 times the powers of ten around the values") {
  const auto positions_of = [](const std::vector<double>& values) {
    const Histogram histogram = histogram_of(values);
    std::vector<double> positions;
    for (const FigureTick& tick : FigureDistribution(Kind::Ecdf, false, {&histogram}).ticks())
      positions.push_back(tick.position);
    return positions;
  };
  CHECK(positions_of({0.3, 3.0}) == std::vector<double>{0.2, 0.5, 1.0, 2.0, 5.0});
  CHECK(positions_of({0.0, infinity}) == std::vector<double>{0.1, 0.2, 0.5, 1.0});
  const Histogram wide = histogram_of({1e-3, 1e3});
  for (const FigureTick& tick : FigureDistribution(Kind::Ecdf, false, {&wide}).ticks()) {
    INFO(tick.position);
    CHECK(tick.label.empty() == (std::abs(std::remainder(std::log10(tick.position), 1.0)) > 0.1));
  }
}

FigureSpec distribution_spec(const char* kind) {
  FigureSpec spec;
  spec.name = "errors";
  spec.kind = kind;
  spec.y = {"error_all_m"};
  spec.group = {"points"};
  spec.facet = "range_sigma_m";
  return spec;
}

TEST_CASE("a distribution is a figure with a line per group") {
  const FigureData data = figure_data(synthetic_summary(), distribution_spec("ecdf"));
  CHECK(data.x_label == "position error, all trials [m]");
  CHECK(data.scales.at(0).label == "cumulative share of the values");
  CHECK(data.log_x);
  REQUIRE(data.panels.size() == 2);
  REQUIRE(data.panels[0].lines.size() == 4);
  CHECK(data.style == FigureStyle::Lines);  // four bands would hide each other
  CHECK(data.panels[0].lines[0].points.back().y == 0.8);
  CHECK(data.footnote ==
        "5 values per line; outside of the axis: at most 20 % of a line; lines share trials and are not independent");

  FigureSpec spec = distribution_spec("ecdf");
  spec.methods = {"rr"};
  CHECK(figure_data(synthetic_summary(), spec).style == FigureStyle::Bands);
  CHECK(figure_data(synthetic_summary(), distribution_spec("histogram")).style == FigureStyle::Lines);
}

TEST_CASE("what a distribution cannot show is refused") {
  const auto message_of = [](auto change) -> std::string {
    FigureSpec spec = distribution_spec("ecdf");
    Summary summary = synthetic_summary();
    change(spec, summary);
    return tests::refusal_of([&] { figure_data(summary, spec); });
  };
  CHECK(message_of([](FigureSpec& s, Summary&) { s.kind = "ecfd"; }) ==
        "figure 'errors': kind = \"ecfd\" is unknown; valid names: ecdf, curve, histogram");
  CHECK(message_of([](FigureSpec& s, Summary&) { s.x = "points"; }).find("takes no x") != std::string::npos);
  CHECK(message_of([](FigureSpec& s, Summary&) { s.statistic = "mean"; }).find("no statistic") != std::string::npos);
  CHECK(message_of([](FigureSpec& s, Summary&) {
          s.y = {"error_m", "error_all_m"};
        }).find("one metric") != std::string::npos);
  CHECK(message_of([](FigureSpec& s, Summary&) { s.y = {"converged"}; }).find("is yes or no") != std::string::npos);
  CHECK(message_of([](FigureSpec& s, Summary&) { s.group.clear(); }) ==
        "figure 'errors': several cells fall on one line, among them points = 5, range_sigma_m = 0.1; add to group or "
        "facet: points");
  CHECK(message_of([](FigureSpec&, Summary& s) {
          s.statistics[0].metrics[1] = statistics_of(std::vector{-1.0, 1.0});
        }).find("has negative values") != std::string::npos);
}

}  // namespace
