#pragma once

#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// The simulation of the RRR paper's section 4: a camera at an unknown position measures noisy ranges to n objects of
/// known position in its field of view; every method solves the same trials.
const Experiment& ranging_experiment();

}  // namespace ridgeloc::studies
