#pragma once

#include <memory>
#include <span>

#include "studies/ranging/ranging_settings.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// `Experiment::prepare` of `ranging`: trials of a cell, solved with some methods. It offers `FailureRecount` and
/// `TrialReplay`.
std::unique_ptr<const Simulation> ranging_simulation(const StudyKey& key, const Cell& cell,
                                                     std::span<const Method> methods);

/// Whether the noise is normal and of one level, as the bound and the covariance of least squares have it.
bool has_plain_noise(const RangingCell& settings);

}  // namespace ridgeloc::studies
