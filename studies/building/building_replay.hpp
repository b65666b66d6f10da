#pragma once

#include <cstdint>
#include <span>

#include "studies/building/building_trials.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// One photo of the `building` experiment told in full: what it shows, where the starts are, how each method ends from
/// each of them. See `Experiment::replay`.
Replay replay_building(std::uint64_t seed, const Cell& cell, std::span<const Method> methods, std::uint64_t trial,
                       BuildingScratch& scratch);

}  // namespace ridgeloc::studies
