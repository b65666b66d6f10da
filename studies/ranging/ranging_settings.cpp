#include "studies/ranging/ranging_settings.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "studies/solving/solver_settings.hpp"
#include "studies/study/setting_builders.hpp"

namespace ridgeloc::studies {

namespace {

/// The rear camera of an iPhone 6: 61.1 x 47.7 degrees.
constexpr Interval iphone6_azimuth_deg = {-30.55, 30.55};
constexpr Interval iphone6_elevation_deg = {-23.85, 23.85};

/// The setting, read only where a noise model is chosen that reads it.
Setting read_by_noise(const Setting& setting) {
  Condition condition{"noise_model", {}};
  for (const sim::NoiseEntry& entry : sim::noise_registry()) {
    const bool reads = std::ranges::find(entry.options, setting.name) != entry.options.end();
    if (reads) condition.choices.emplace_back(entry.name);
  }
  return read_if(condition, setting);
}

std::vector<Setting> make_settings() {
  const sim::FieldOfView view;
  const sim::NoiseOptions standard;
  const Section scene("scene");
  const Section noise("noise");
  const Condition with_scores{"scores", {"random"}};
  const Condition for_pseudoranges{"model", {"pseudorange"}};
  const Condition if_drawn{"objects", {"drawn"}};
  const Condition if_given{"objects", {"given"}};
  constexpr Interval map_m = {-1e5, 1e5};
  const auto camera_interval = [&](const char* name, const char* axis) {
    return read_if(if_given,
                   scene.range(name, {0, 0}, map_m, "m",
                               std::string("true ") + axis + " of the camera, uniform, where camera_m is empty"));
  };
  std::vector<Setting> settings = {
      scene.choice("model", {"range", "pseudorange"}, "range",
                   "what is measured: ranges, or pseudoranges in a photo with unknown image distance"),
      scene.choice("objects", {"drawn", "given"}, "drawn",
                   "objects drawn in the field of view of a camera at the origin, or given by objects_m"),
      read_if(if_drawn, scene.integer("points", 5, {3, 1000}, "number of points")),
      read_if(if_drawn,
              scene.range("azimuth_deg", view.azimuth_deg, {-180, 180}, "deg", "horizontal field of view, uniform")),
      read_if(if_drawn,
              scene.range("elevation_deg", view.elevation_deg, {-90, 90}, "deg", "vertical field of view, uniform")),
      read_if(if_drawn,
              scene.range("depth_m", view.depth_m, {1e-3, 1e5}, "m", "distance of the points from the camera")),
      read_if(if_drawn, scene.choice("depth_distribution", sim::depth_distribution_names, view.depth_distribution,
                                     "uniform in depth, or in volume (density grows with depth^2)")),
      scene.real("start_offset_m", view.start_offset_m, {0, 1e5}, "m",
                 "distance of the start from the truth, in a random direction"),
      read_if(if_drawn, scene.choice("camera", {"given", "iphone6"}, "given",
                                     "field of view: as given, or that of an iPhone 6 (61.1 x 47.7 degrees)")),
      read_if(if_given, scene.positions("objects_m", map_m, "where the objects are")),
      read_if(if_given,
              scene.integer("objects_used", 0, {0, 1000}, "how many of them, the first ones, are measured; 0: all")),
      read_if(if_given, scene.positions("camera_m", map_m,
                                        "true positions of the camera, one of them in each trial; none: as below")),
      camera_interval("camera_x_m", "x"),
      camera_interval("camera_y_m", "y"),
      camera_interval("camera_z_m", "z"),
      scene.choice("z_mode", solvers::z_mode_names, solvers::ZMode::Free, "height of the camera: an unknown, or known"),
      read_if(for_pseudoranges, scene.real("focal_length_mm", 4.15, {0.1, 1000}, "mm", "focal length of the lens")),
      noise.choice("noise_model", names_of(sim::noise_registry()), "normal", "distribution of the range errors"),
      noise.real("range_sigma_m", standard.range_sigma_m, {0, 1e4}, "m", "standard deviation of the range errors"),
      noise.choice("noise_is_variance", {"off", "on"}, "off", "read range_sigma_m as a variance (m^2)"),
      read_by_noise(noise.real("noise_dof", standard.dof, {2.1, 1000}, "1", "degrees of freedom of student_t")),
      read_by_noise(
          noise.real("outlier_rate", standard.outlier_rate, {0, 1}, "1", "share of outliers among the errors")),
      read_by_noise(noise.real("outlier_size", standard.outlier_size, {1, 1e4}, "1",
                               "by how much outliers are larger than good errors")),
      read_by_noise(noise.real("reference_depth_m", standard.reference_depth_m, {1e-3, 1e5}, "m",
                               "range at which the standard deviation is range_sigma_m")),
      read_by_noise(noise.samples("noise_samples", {-1e6, 1e6},
                                  "errors to draw from, scaled to a root mean square of range_sigma_m")),
      noise.choice("scores", {"none", "random"}, "none",
                   "detection scores: none, or random ones, uniform from score_low to 1"),
      read_if(with_scores, noise.real("score_low", standard.score.low, {0.01, 1}, "1", "smallest score")),
      read_if(with_scores, noise.real("score_error_exponent", standard.score.error_exponent, {-3, 3}, "1",
                                      "errors are proportional to score to this power; at 0 scores say nothing")),
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

sim::PositionColumns columns_of(const Positions& positions) {
  return {positions.column(0), positions.column(1), positions.column(2)};
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
  knows_height = get<std::string>(values, "z_mode") == "fixed";
  view.start_at_height = knows_height;
  if (get<std::string>(values, "objects") == "given") {
    const auto& objects = get<Positions>(values, "objects_m");
    const auto used = static_cast<std::size_t>(get<std::int64_t>(values, "objects_used"));
    points = used > 0 ? used : objects.size();
    given = sim::GivenScene{
        columns_of(objects),
        columns_of(get<Positions>(values, "camera_m")),
        {get<Interval>(values, "camera_x_m"), get<Interval>(values, "camera_y_m"), get<Interval>(values, "camera_z_m")},
        view.start_offset_m,
        knows_height};
  }
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
