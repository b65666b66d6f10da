#include "studies/ranging/ranging_trials.hpp"

#include "sim/kernels.hpp"

namespace ridgeloc::studies {

core::Oracle simulate_ranging(std::uint64_t seed, const RangingCell& settings, TrialRange range,
                              RangingScratch& scratch) {
  scratch.problems.reshape(settings.points, range.count);
  const sim::Kernels scene = sim::kernels(scratch.isa);
  scene.place_objects(settings.view, sim::SceneStreams(seed, settings.view), range.first, scratch.problems);
  if (settings.has_scores) {
    scratch.problems.add_scores();
    scene.draw_scores(settings.noise_options.score, core::Stream(seed, "score"), range.first, scratch.problems);
  }
  scene.measure_ranges(*settings.noise, settings.noise_options, core::Stream(seed, "noise", settings.noise->name),
                       range.first, scratch.problems);

  core::Oracle oracle;
  if (settings.has_images) {
    scratch.problems.add_images();
    scratch.image_distance.resize(range.count);
    scene.take_images(settings.focal_length_mm, scratch.problems, scratch.image_distance);
    oracle.image_distance = scratch.image_distance;
  }
  for (std::size_t axis = 0; axis < 3; ++axis) {
    scratch.truth[axis].assign(range.count, sim::true_position_m[axis]);
    oracle.truth[axis] = scratch.truth[axis];
  }
  oracle.range_sigma_m = settings.range_sigma_m;
  oracle.k_error = core::Stream(seed, "k_error");
  oracle.first_trial = range.first;
  return oracle;
}

}  // namespace ridgeloc::studies
