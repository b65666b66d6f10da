#include "studies/ranging/ranging_drawing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <initializer_list>
#include <limits>
#include <type_traits>
#include <utility>

#include "results/schema/text.hpp"
#include "solvers/models/least_squares.hpp"
#include "solvers/models/models.hpp"
#include "solvers/models/weight.hpp"

namespace ridgeloc::studies {

namespace {

using results::AxisRange;
using results::DrawnPoint;

/// More numbers than these at the objects would be a thicket.
constexpr std::size_t most_numbered = 30;

DrawnPoint from_above(const std::array<double, 3>& position) {
  return {position[0], position[1]};
}

/// The box around objects, truth and start, grown so that it also holds what else happens near it, and by a margin.
results::DrawingWindow window_of(const std::vector<DrawnPoint>& fixed, const std::vector<DrawnPoint>& moving) {
  constexpr double reach = 0.5;    // of the longer side
  constexpr double margin = 0.05;  // likewise
  results::DrawingWindow box{{fixed[0].x, fixed[0].x}, {fixed[0].y, fixed[0].y}};
  const auto include = [&box](const DrawnPoint& p) {
    box.x = {std::min(box.x.low, p.x), std::max(box.x.high, p.x)};
    box.y = {std::min(box.y.low, p.y), std::max(box.y.high, p.y)};
  };
  const auto grown = [&box](double share) {
    const double by = share * std::max({box.x.high - box.x.low, box.y.high - box.y.low, 1e-3});
    return results::DrawingWindow{{box.x.low - by, box.x.high + by}, {box.y.low - by, box.y.high + by}};
  };
  for (const DrawnPoint& p : fixed) include(p);
  const results::DrawingWindow near = grown(reach);
  for (const DrawnPoint& p : moving) {
    if (near.contains(p)) include(p);
  }
  return results::fitted(grown(margin));
}

/// Round numbers between two others, each about twice the one before, or less where these would be few.
std::vector<double> round_levels(double low, double high) {
  constexpr double widest = 1e-3;  // low over high
  constexpr std::size_t few = 5;
  std::vector<double> levels;
  if (!(low < high)) return levels;
  const auto collect = [&](std::initializer_list<double> digits) {
    levels.clear();
    const int first = static_cast<int>(std::floor(std::log10(std::max(low, high * widest))));
    const int last = static_cast<int>(std::floor(std::log10(high)));
    for (int power = first; power <= last; ++power) {
      for (const double digit : digits) {
        const double level = results::decimal_number(digit, power);
        if (level > low && level < high) levels.push_back(level);
      }
    }
  };
  collect({1, 2, 5});
  if (levels.size() < few) collect({1, 1.5, 2, 3, 5, 7});
  return levels;
}

/// Least squares over the window, at one height and image distance.
results::DrawnContours contours_of(const core::ProblemBatch& problems, const solvers::SolverOptions& options,
                                   const solvers::ReferencePlace& through, const results::DrawingWindow& window) {
  constexpr std::size_t columns = 151;
  const double width = window.x.high - window.x.low;
  const double height = window.y.high - window.y.low;
  const auto rows = static_cast<std::size_t>(std::lround(height / width * static_cast<double>(columns - 1))) + 1;
  const auto n = static_cast<double>(problems.points());
  const solvers::ScoreWeights weights(options);
  results::DrawnContours contours;
  contours.label = "equal residuals";
  double low = std::numeric_limits<double>::infinity();
  double high = 0.0;
  solvers::with_model<double, solvers::KernelSize::Small>(
      problems, options, [&]<class Model>(std::type_identity<Model>) {
        const Model model(problems, 0, options);
        for (std::size_t i = 0; i < rows; ++i) {
          std::vector<double>& row = contours.values.emplace_back();
          for (std::size_t j = 0; j < columns; ++j) {
            const double x = window.x.low + width * static_cast<double>(j) / static_cast<double>(columns - 1);
            const double y = window.y.low + height * static_cast<double>(i) / static_cast<double>(rows - 1);
            const auto u = model.given({x, y, through.position[2]}, through.image_distance_mm);
            row.push_back(std::sqrt(solvers::weighted_squares(model, u, weights) / n));
            if (!std::isfinite(row.back())) continue;
            low = std::min(low, row.back());
            high = std::max(high, row.back());
          }
        }
      });
  contours.levels = round_levels(low, high);
  return contours;
}

/// Contours through the height of the minimum of least squares, and the footnote that says so.
void add_contours(const core::ProblemBatch& problems, const core::Oracle& oracle, const solvers::SolverOptions& shared,
                  results::Drawing& drawing) {
  solvers::SolverOptions squares = shared;
  squares.jacobian = solvers::Jacobian::Exact;
  squares.residual = solvers::Residual::Range;
  const auto objective = *solvers::reference_objective(solvers::ReferenceLoss::WeightedSquares, squares);
  const Audit::Answers least = Audit(problems, oracle, {}).solve(0, objective);
  solvers::ReferencePlace through({oracle.truth[0][0], oracle.truth[1][0], oracle.truth[2][0]});
  if (!oracle.image_distance.empty()) through.image_distance_mm = oracle.image_distance[0];
  const char* height_of = "that of the truth";
  if (least.from_start.converged || least.from_truth.converged) {
    through = (least.from_start.converged ? least.from_start : least.from_truth).place();
    height_of = "that of Ceres' minimiser";
  }
  drawing.contours = contours_of(problems, squares, through, drawing.window);
  const auto& levels = drawing.contours->levels;
  drawing.footnote = fmt::format(
      "the scene from above; small marks are iterates, a hollow last one did not converge; the number is that of the "
      "iterations; minima have the colour of a method with that objective; contours: root mean square of the weighted "
      "residuals at z = {:.3g} m, {}{}",
      through.position[2], height_of, levels.empty() ? "" : fmt::format(", at {} m", fmt::join(levels, ", ")));
}

results::DrawnPath drawn(const RangingPath& path) {
  results::DrawnPath out;
  out.label = path.label;
  out.note = fmt::format("{}, {:.0f}", core::status_names[static_cast<std::size_t>(path.status)], path.steps);
  out.filled_end = path.status == core::Status::Converged;
  for (const auto& iterate : path.iterates) out.points.push_back(from_above(iterate.position));
  return out;
}

/// Minima that the reference has found, each once, in the colour of the first method with that objective.
results::DrawnPlaces minima(const std::vector<RangingPath>& paths, solvers::Minimizer Audit::Answers::*from,
                            const std::vector<DrawnPoint>& known) {
  constexpr double same_place_m = 0.01;
  results::DrawnPlaces places;
  for (std::size_t i = 0; i < paths.size(); ++i) {
    if (!paths[i].reference || !((*paths[i].reference).*from).converged) continue;
    const DrawnPoint at = from_above(((*paths[i].reference).*from).estimate);
    const auto is_same = [&](const DrawnPoint& p) { return std::hypot(p.x - at.x, p.y - at.y) < same_place_m; };
    if (std::ranges::any_of(places.points, is_same) || std::ranges::any_of(known, is_same)) continue;
    places.points.push_back(at);
    places.paths.push_back(i);
  }
  return places;
}

}  // namespace

results::Drawing ranging_drawing(const core::ProblemBatch& problems, const core::Oracle& oracle,
                                 const solvers::SolverOptions& shared, const std::vector<RangingPath>& paths) {
  results::Drawing drawing;
  drawing.x_label = "x [m], forward";
  drawing.y_label = "y [m], to the left";
  std::vector<DrawnPoint> objects;
  std::vector<std::string> numbers;
  for (std::size_t j = 0; j < problems.points(); ++j) {
    objects.push_back({problems.position(j, 0)[0], problems.position(j, 1)[0]});
    if (problems.points() <= most_numbered) numbers.push_back(fmt::format("{}", j + 1));
  }
  const DrawnPoint truth{oracle.truth[0][0], oracle.truth[1][0]};
  const DrawnPoint start{problems.start(0)[0], problems.start(1)[0]};
  results::DrawnPlaces from_start = minima(paths, &Audit::Answers::from_start, {});
  results::DrawnPlaces from_truth = minima(paths, &Audit::Answers::from_truth, from_start.points);

  std::vector<DrawnPoint> fixed = objects;
  fixed.push_back(truth);
  fixed.push_back(start);
  std::vector<DrawnPoint> moving = from_start.points;
  moving.insert(moving.end(), from_truth.points.begin(), from_truth.points.end());
  for (const RangingPath& path : paths) {
    drawing.paths.push_back(drawn(path));
    moving.insert(moving.end(), drawing.paths.back().points.begin(), drawing.paths.back().points.end());
  }
  drawing.window = window_of(fixed, moving);

  using results::DrawnMark;
  drawing.places.push_back({"object", DrawnMark::Dot, objects, numbers, {}});
  drawing.places.push_back({"truth", DrawnMark::Plus, {truth}, {}, {}});
  drawing.places.push_back({"start", DrawnMark::Square, {start}, {}, {}});
  from_start.label = "Ceres from the start";
  from_start.mark = DrawnMark::Diamond;
  from_truth.label = "Ceres from the truth";
  from_truth.mark = DrawnMark::Triangle;
  for (results::DrawnPlaces& places : {std::ref(from_start), std::ref(from_truth)}) {
    if (!places.points.empty()) drawing.places.push_back(std::move(places));
  }

  add_contours(problems, oracle, shared, drawing);
  return drawing;
}

}  // namespace ridgeloc::studies
