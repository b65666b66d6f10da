#pragma once

#include <cstdint>

#include "studies/detection/detection_trials.hpp"
#include "studies/study/experiment.hpp"
#include "studies/study/replay.hpp"

namespace ridgeloc::studies {

/// One trial of the `detection` experiment told in full: the camera, the object, what the detector makes of it, and the
/// floor from above. See `TrialReplay::replay`.
/// Throws core::InputError where the trial has no photo. The trials are of the cell.
Replay replay_detection(const DetectionCell& cell, const DetectionTrials& trials, std::uint64_t trial,
                        sim::Photo& photo);

}  // namespace ridgeloc::studies
