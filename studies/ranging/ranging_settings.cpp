#include "studies/ranging/ranging_settings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "studies/solving/solver_settings.hpp"

namespace ridgeloc::studies {

namespace {

template <std::size_t N>
std::vector<std::string> strings(const std::array<std::string_view, N>& names) {
  return {names.begin(), names.end()};
}

template <class Registry>
std::vector<std::string> names_of(const Registry& registry) {
  std::vector<std::string> names;
  for (const auto& entry : registry) names.emplace_back(entry.name);
  return names;
}

constexpr std::array<std::string_view, 2> score_names = {"none", "random"};
constexpr std::array<std::string_view, 2> measurement_names = {"range", "pseudorange"};
constexpr std::array<std::string_view, 2> camera_names = {"given", "iphone6"};
constexpr std::array<std::string_view, 2> off_on = {"off", "on"};

/// The rear camera of an iPhone 6: 61.1 x 47.7 degrees.
constexpr Interval iphone6_azimuth_deg = {-30.55, 30.55};
constexpr Interval iphone6_elevation_deg = {-23.85, 23.85};

/// The noise models that read a setting.
Condition read_by_noise(std::string_view setting) {
  Condition condition{"noise_model", {}};
  for (const sim::NoiseEntry& entry : sim::noise_registry()) {
    if (std::ranges::find(entry.options, setting) != entry.options.end()) condition.choices.emplace_back(entry.name);
  }
  return condition;
}

std::vector<Setting> make_settings() {
  const sim::FieldOfView view;
  const sim::NoiseOptions noise;
  const Condition with_scores{"scores", {"random"}};
  const Condition for_pseudoranges{"model", {"pseudorange"}};
  const auto integer = [](std::int64_t v) { return Value(v); };
  std::vector<Setting> settings = {
      {"scene", "model", Kind::Choice, std::string("range"), 0, 0, strings(measurement_names), "1",
       "what is measured: ranges, or pseudoranges in a photo with unknown image distance", false},
      {"scene", "points", Kind::Integer, integer(5), 3, 1000, {}, "1", "number of points", false},
      {"scene",
       "azimuth_deg",
       Kind::Range,
       view.azimuth_deg,
       -180,
       180,
       {},
       "deg",
       "horizontal field of view, uniform",
       false},
      {"scene",
       "elevation_deg",
       Kind::Range,
       view.elevation_deg,
       -90,
       90,
       {},
       "deg",
       "vertical field of view, uniform",
       false},
      {"scene",
       "depth_m",
       Kind::Range,
       view.depth_m,
       1e-3,
       1e5,
       {},
       "m",
       "distance of the points from the camera",
       false},
      {"scene", "depth_distribution", Kind::Choice, std::string("uniform"), 0, 0,
       strings(sim::depth_distribution_names), "1", "uniform in depth, or in volume (density grows with depth^2)",
       false},
      {"scene",
       "start_offset_m",
       Kind::Real,
       view.start_offset_m,
       0,
       1e5,
       {},
       "m",
       "distance of the start from the truth, in a random direction",
       false},
      {"scene", "camera", Kind::Choice, std::string("given"), 0, 0, strings(camera_names), "1",
       "field of view: as given, or that of an iPhone 6 (61.1 x 47.7 degrees)", false},
      {"scene", "z_mode", Kind::Choice, std::string("free"), 0, 0, strings(solvers::z_mode_names), "1",
       "height of the camera: an unknown, or known", false, for_pseudoranges},
      {"scene",
       "focal_length_mm",
       Kind::Real,
       4.15,
       0.1,
       1000,
       {},
       "mm",
       "focal length of the lens",
       false,
       for_pseudoranges},
      {"noise", "noise_model", Kind::Choice, std::string("normal"), 0, 0, names_of(sim::noise_registry()), "1",
       "distribution of the range errors", false},
      {"noise",
       "range_sigma_m",
       Kind::Real,
       noise.range_sigma_m,
       0,
       1e4,
       {},
       "m",
       "standard deviation of the range errors",
       false},
      {"noise", "noise_is_variance", Kind::Choice, std::string("off"), 0, 0, strings(off_on), "1",
       "read range_sigma_m as a variance (m^2)", false},
      {"noise",
       "noise_dof",
       Kind::Real,
       noise.dof,
       2.1,
       1000,
       {},
       "1",
       "degrees of freedom of student_t",
       false,
       read_by_noise("noise_dof")},
      {"noise",
       "outlier_rate",
       Kind::Real,
       noise.outlier_rate,
       0,
       1,
       {},
       "1",
       "share of outliers among the errors",
       false,
       read_by_noise("outlier_rate")},
      {"noise",
       "outlier_size",
       Kind::Real,
       noise.outlier_size,
       1,
       1e4,
       {},
       "1",
       "by how much outliers are larger than good errors",
       false,
       read_by_noise("outlier_size")},
      {"noise",
       "reference_depth_m",
       Kind::Real,
       noise.reference_depth_m,
       1e-3,
       1e5,
       {},
       "m",
       "range at which the standard deviation is range_sigma_m",
       false,
       read_by_noise("reference_depth_m")},
      {"noise",
       "noise_samples",
       Kind::Samples,
       Samples(),
       -1e6,
       1e6,
       {},
       "1",
       "errors to draw from, scaled to a root mean square of range_sigma_m",
       false,
       read_by_noise("noise_samples")},
      {"noise", "scores", Kind::Choice, std::string("none"), 0, 0, strings(score_names), "1",
       "detection scores: none, or random ones, uniform from score_low to 1", false},
      {"noise", "score_low", Kind::Real, noise.score.low, 0.01, 1, {}, "1", "smallest score", false, with_scores},
      {"noise",
       "score_error_exponent",
       Kind::Real,
       noise.score.error_exponent,
       -3,
       3,
       {},
       "1",
       "errors are proportional to score to this power; at 0 scores say nothing",
       false,
       with_scores},
  };
  std::ranges::move(solver_settings(), std::back_inserter(settings));
  return settings;
}

template <class T>
const T& get(const Values& values, std::string_view name) {
  return std::get<T>(values.find(name)->second);
}

/// The enumerator whose name stands in `values`.
template <class Enum, std::size_t N>
Enum choice(const std::string& name, const std::array<std::string_view, N>& names) {
  return static_cast<Enum>(std::ranges::find(names, name) - names.begin());
}

}  // namespace

std::span<const Setting> ranging_settings() {
  static const std::vector<Setting> settings = make_settings();
  return settings;
}

RangingCell::RangingCell(const Values& values)
    : points(static_cast<std::size_t>(get<std::int64_t>(values, "points"))),
      range_sigma_m(get<double>(values, "range_sigma_m")) {
  view.azimuth_deg = get<Interval>(values, "azimuth_deg");
  view.elevation_deg = get<Interval>(values, "elevation_deg");
  view.depth_m = get<Interval>(values, "depth_m");
  view.depth_distribution =
      choice<sim::DepthDistribution>(get<std::string>(values, "depth_distribution"), sim::depth_distribution_names);
  if (get<std::string>(values, "camera") == "iphone6") {
    view.azimuth_deg = iphone6_azimuth_deg;
    view.elevation_deg = iphone6_elevation_deg;
  }
  view.start_offset_m = get<double>(values, "start_offset_m");
  has_images = get<std::string>(values, "model") == "pseudorange";
  view.start_at_height = has_images && get<std::string>(values, "z_mode") == "fixed";
  focal_length_mm = get<double>(values, "focal_length_mm");
  if (get<std::string>(values, "noise_is_variance") == "on") range_sigma_m = std::sqrt(range_sigma_m);
  noise = sim::find_noise(get<std::string>(values, "noise_model"));
  noise_options.range_sigma_m = range_sigma_m;
  noise_options.dof = get<double>(values, "noise_dof");
  noise_options.outlier_rate = get<double>(values, "outlier_rate");
  noise_options.outlier_size = get<double>(values, "outlier_size");
  noise_options.reference_depth_m = get<double>(values, "reference_depth_m");
  noise_options.samples = get<Samples>(values, "noise_samples").values();
  noise_options.samples_rms = get<Samples>(values, "noise_samples").rms();
  noise_options.score.low = get<double>(values, "score_low");
  noise_options.score.error_exponent = get<double>(values, "score_error_exponent");
  has_scores = get<std::string>(values, "scores") == "random";
}

}  // namespace ridgeloc::studies
