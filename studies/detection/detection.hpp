#pragma once

#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// The detector of the building experiment by itself (RRR paper, Fig. 5): a trial is one object that a photo shows,
/// each object of all photos as likely as any other; is it found, and how wrong is its pseudorange?
const Experiment& detection_experiment();

}  // namespace ridgeloc::studies
