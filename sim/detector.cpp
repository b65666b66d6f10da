#include "sim/detector.hpp"

#include <algorithm>
#include <cmath>

#include "core/random.hpp"

namespace ridgeloc::sim {

namespace {

/// Random blocks that an object has of each picture.
enum DetectionDraw : std::uint64_t {
  Found,
  VerticalEdges,
  HorizontalEdges,
  Outlier,
  CentreShift,
  Height,
  Score,
  detection_draws
};

constexpr std::uint64_t draws_of_attempt = std::uint64_t{1} << 32;

/// The share of normal errors of standard deviation 1 that are smaller than |z|, within 0.02 (logistic function).
double rank_of(double z) {
  const double slope = -1.702;
  // Beyond this it is 1 to the last bit, and the exponential's range is not left.
  return 2.0 / (1.0 + core::exp(std::max(slope * std::fabs(z), -700.0))) - 1.0;
}

}  // namespace

core::Stream detector_stream(std::uint64_t seed) {
  return {seed, "detector"};
}

std::optional<Detection> detect(const DetectorModel& model, const BuildingMap& map, const View& view,
                                const core::Stream& stream, std::uint64_t trial, std::uint64_t attempt) {
  const MapObject& object = map.objects[view.object];
  const auto block = [&](DetectionDraw draw) {
    return stream.block(trial, attempt * draws_of_attempt + view.object * detection_draws + draw);
  };
  const auto normals = [&](DetectionDraw draw) { return core::normal_pair(core::uniform_pair(block(draw))); };

  const bool near = view.range_m <= model.near_m;
  const auto& of_class = map.classes[object.object_class].recall;
  const double recall = of_class ? (*of_class)[near ? 0 : 1] : (near ? model.recall_near : model.recall_far);
  const auto found = core::uniform_triple(block(Found));
  if (found[0] > recall) return std::nullopt;

  Detection detection;
  detection.object = view.object;
  detection.object_class = object.object_class;
  if (found[1] < model.false_class_rate && map.classes.size() > 1) {
    const auto others = static_cast<double>(map.classes.size() - 1);
    const auto other = static_cast<std::size_t>(found[2] * others);
    detection.object_class = other < object.object_class ? other : other + 1;
  }
  const auto vertical = normals(VerticalEdges);      // left, right
  const auto horizontal = normals(HorizontalEdges);  // upper, lower
  double upper = model.edge_sigma * horizontal[0];   // shares of the height, downwards
  double lower = model.edge_sigma * horizontal[1];
  const auto outlier = core::uniform_triple(block(Outlier));
  if (outlier[0] < model.outlier_rate) {
    // Four equal cases: which edge, and to which side.
    const double sign = outlier[2] < 0.5 ? -1.0 : 1.0;
    const double size = model.outlier_size[0] + (model.outlier_size[1] - model.outlier_size[0]) * outlier[1];
    (outlier[2] < 0.25 || outlier[2] >= 0.75 ? upper : lower) += sign * size;
  }
  const auto shift = normals(CentreShift);
  const double left = model.edge_sigma * vertical[0];
  const double right = model.edge_sigma * vertical[1];
  // A box keeps a tenth of its size, whatever the errors: a detector draws no box upside down.
  constexpr double smallest = 0.1;
  const Box& box = view.box;
  detection.box.x_px = box.x_px + box.width_px * (0.5 * (left + right) + model.centre_sigma * shift[0]);
  detection.box.y_px = box.y_px + box.height_px * (0.5 * (upper + lower) + model.centre_sigma * shift[1]);
  detection.box.width_px = box.width_px * std::max(1.0 + right - left, smallest);
  detection.box.height_px = box.height_px * std::max(1.0 + lower - upper, smallest);

  detection.height_factor = std::max(1.0 + model.height_sigma * normals(Height)[0], smallest);
  const auto score = core::uniform_pair(block(Score));
  const double error = (lower - upper) / (std::sqrt(2.0) * std::max(model.edge_sigma, 1e-12));
  const double good = score[0] < model.score_link ? 1.0 - rank_of(error) : score[1];
  detection.score = model.score_low + (1.0 - model.score_low) * good;
  return detection;
}

double Pseudorange::range_m(double image_distance_mm) const {
  return std::sqrt(alpha * image_distance_mm * image_distance_mm + rho);
}

Pseudorange pseudorange(const Camera& camera, const Box& box, double height_m) {
  const double per_mm = height_m * camera.pixels_per_mm() / box.height_px;
  const double off_axis_px2 = box.x_px * box.x_px + box.y_px * box.y_px;
  const double alpha = per_mm * per_mm;
  return {alpha, alpha * off_axis_px2 / (camera.pixels_per_mm() * camera.pixels_per_mm())};
}

Pseudorange pseudorange(const Camera& camera, const Detection& detection, const MapObject& taken_for) {
  return pseudorange(camera, detection.box, taken_for.height_m * detection.height_factor);
}

}  // namespace ridgeloc::sim
