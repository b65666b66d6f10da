#include "studies/ranging/ranging_trials.hpp"

#include <algorithm>

#include "sim/kernels.hpp"

namespace ridgeloc::studies {

core::Oracle simulate_ranging(std::uint64_t seed, const RangingCell& settings, TrialRange range,
                              RangingScratch& scratch) {
  scratch.problems.reshape(settings.points, range.count);
  const sim::Kernels scene = sim::kernels(scratch.isa);
  for (std::vector<double>& column : scratch.truth) column.resize(range.count);
  const sim::TruthColumns truth = {scratch.truth[0], scratch.truth[1], scratch.truth[2]};
  const sim::GivenSceneStreams given_streams(seed);
  if (settings.given) {
    scene.place_camera(*settings.given, given_streams, range.first, truth, scratch.problems);
  } else {
    scene.place_objects(settings.view, sim::SceneStreams(seed, settings.view), range.first, scratch.problems);
    for (std::size_t axis = 0; axis < truth.size(); ++axis) std::ranges::fill(truth[axis], sim::true_position_m[axis]);
  }
  if (settings.has_scores) {
    scratch.problems.add_scores();
    scene.draw_scores(settings.noise_options.score, core::Stream(seed, "score"), range.first, scratch.problems);
  }
  scene.measure_ranges(*settings.noise, settings.noise_options, core::Stream(seed, "noise", settings.noise->name),
                       range.first, scratch.problems);
  if (settings.given) scene.show_map(*settings.given, given_streams, range.first, truth, scratch.problems);

  core::Oracle oracle;
  if (settings.has_images) {
    scratch.problems.add_images();
    scratch.image_distance.resize(range.count);
    scene.take_images(settings.focal_length_mm, scratch.problems, scratch.image_distance);
    oracle.image_distance = scratch.image_distance;
  }
  for (std::size_t axis = 0; axis < truth.size(); ++axis) oracle.truth[axis] = truth[axis];
  oracle.range_sigma_m = settings.range_sigma_m;
  oracle.k_error = core::Stream(seed, "k_error");
  oracle.first_trial = range.first;
  return oracle;
}

}  // namespace ridgeloc::studies
