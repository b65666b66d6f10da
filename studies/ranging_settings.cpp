#include "studies/ranging_settings.hpp"

#include <algorithm>

#include "solvers/solver.hpp"

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
  const solvers::SolverOptions solver;
  const auto integer = [](std::int64_t v) { return Value(v); };
  return {
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
       "standard deviation of the range errors; contaminated: of the good ones, proportional: at reference_depth_m, "
       "empirical: root mean square",
       false},
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
      {"solver",
       "max_iterations",
       Kind::Integer,
       integer(solver.max_iterations),
       1,
       1'000'000,
       {},
       "1",
       "steps after which a trial has failed",
       true},
      {"solver",
       "step_tolerance_m",
       Kind::Real,
       solver.step_tolerance_m,
       1e-15,
       1e3,
       {},
       "m",
       "converged when a step is shorter",
       true},
      {"solver", "k", Kind::Choice, std::string("kibria_gm"), 0, 0, names_of(solvers::k_estimator_registry()), "1",
       "estimator of the ridge parameter K", true},
      {"solver", "k_fixed", Kind::Real, solver.k_fixed, 0, 1e12, {}, "1", "the constant of k = \"fixed\"", true},
      {"solver",
       "similarity",
       Kind::Real,
       solver.similarity,
       1e-6,
       1,
       {},
       "1",
       "similarity of the oracles' K to the true K",
       true},
      {"solver", "k_error", Kind::Choice, std::string("signed"), 0, 0, strings(solvers::k_error_names), "1",
       "signs of the error that brings the oracles' K to that similarity", true},
      {"solver", "k_error_draw", Kind::Choice, std::string("per_iteration"), 0, 0, strings(solvers::k_error_draw_names),
       "1", "how often the direction of that error is drawn", true},
      {"solver", "ktrue", Kind::Choice, std::string("elem"), 0, 0, strings(solvers::k_true_names), "1",
       "true K that eta refers to: by component, or their geometric mean", true},
      {"solver", "eta", Kind::Choice, std::string("squared"), 0, 0, strings(solvers::eta_names), "1",
       "distance in eta: root of the sum of squares, or of the absolute sum as printed", true},
      {"solver",
       "theta_m",
       Kind::Real,
       solver.theta_m,
       1e-12,
       1e6,
       {},
       "m",
       "robust weights s / max(theta, |e|)",
       true},
  };
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
  view.start_offset_m = get<double>(values, "start_offset_m");
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

solvers::SolverOptions solver_options(const Values& cell, const Values& given) {
  const auto value = [&]<class T>(std::string_view name, T) -> const T& {
    return given.contains(name) ? get<T>(given, name) : get<T>(cell, name);
  };
  const std::string text;
  solvers::SolverOptions options;
  options.max_iterations = static_cast<int>(value("max_iterations", std::int64_t{}));
  options.step_tolerance_m = value("step_tolerance_m", 0.0);
  options.theta_m = value("theta_m", 0.0);
  options.k = *solvers::find_k_estimator(value("k", text));
  options.k_fixed = value("k_fixed", 0.0);
  options.similarity = value("similarity", 0.0);
  options.k_error = choice<solvers::KError>(value("k_error", text), solvers::k_error_names);
  options.k_error_draw = choice<solvers::KErrorDraw>(value("k_error_draw", text), solvers::k_error_draw_names);
  options.k_true = choice<solvers::KTrue>(value("ktrue", text), solvers::k_true_names);
  options.eta = choice<solvers::Eta>(value("eta", text), solvers::eta_names);
  return options;
}

}  // namespace ridgeloc::studies
