#pragma once

#include <cstdint>
#include <span>

#include "studies/detection/detection_trials.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// One trial of the `detection` experiment told in full: the camera, the object, what the detector makes of it, and the
/// floor from above. See `Experiment::replay`.
Replay replay_detection(std::uint64_t seed, const DetectionCell& cell, std::span<const Method> methods,
                        std::uint64_t trial, sim::Photo& photo);

}  // namespace ridgeloc::studies
