#pragma once

#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// The building experiment of the RRR paper (Table 1, Figs. 5, 6): a photo in a building of known map, objects detected
/// in it, coarse positions from what it shows, and fine positioning from each of these by every method.
const Experiment& building_experiment();

}  // namespace ridgeloc::studies
