#pragma once

#include <memory>
#include <span>

#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// `Experiment::prepare` of `building`: photos of a cell, located with some methods. All simulations of a program that
/// need the same map graphs share them. It offers `FailureRecount` and `TrialReplay`. Throws core::InputError where a
/// view shows more objects than a map graph takes.
std::unique_ptr<const Simulation> building_simulation(const StudyKey& key, const Cell& cell,
                                                      std::span<const Method> methods);

}  // namespace ridgeloc::studies
