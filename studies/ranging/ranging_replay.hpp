#pragma once

#include <cstdint>
#include <span>

#include "studies/ranging/ranging_trials.hpp"
#include "studies/study/experiment.hpp"
#include "studies/study/replay.hpp"

namespace ridgeloc::studies {

/// `TrialReplay::replay` of `ranging`.
Replay replay_ranging(std::uint64_t seed, const Cell& cell, std::span<const Method> methods, std::uint64_t trial,
                      RangingScratch& scratch);

}  // namespace ridgeloc::studies
