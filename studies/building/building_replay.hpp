#pragma once

#include <cstdint>
#include <span>

#include "studies/building/building_trials.hpp"
#include "studies/study/experiment.hpp"
#include "studies/study/replay.hpp"

namespace ridgeloc::studies {

/// One photo of the `building` experiment told in full: what it shows, where the starts are, how each method ends from
/// each of them. See `TrialReplay::replay`.
/// Throws core::InputError where the trial has no photo.
Replay replay_building(const BuildingScene& scene, std::span<const Method> methods,
                       std::span<const solvers::SolverOptions> options, std::uint64_t trial, BuildingScratch& scratch);

}  // namespace ridgeloc::studies
