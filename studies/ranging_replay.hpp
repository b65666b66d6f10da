#pragma once

#include <cstdint>
#include <span>

#include "studies/experiment.hpp"
#include "studies/ranging_trials.hpp"
#include "studies/replay.hpp"

namespace ridgeloc::studies {

/// `Experiment::replay` of `ranging`.
Replay replay_ranging(std::uint64_t seed, const Cell& cell, std::span<const Method> methods, std::uint64_t trial,
                      RangingScratch& scratch);

}  // namespace ridgeloc::studies
