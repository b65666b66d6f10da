#pragma once

#include <span>
#include <string_view>

#include "core/problem.hpp"
#include "core/stream.hpp"

namespace ridgeloc::sim {

/// Draws the errors of all observations in units of their standard deviation into the measured ranges of `problems`.
/// Error j of a trial depends on the trial and j alone, never on the noise level or the number of points.
using NoiseModel = void (*)(const core::Stream& noise, std::uint64_t first_trial, core::ProblemBatch& problems);

/// A noise model as users see it.
struct NoiseEntry {
  std::string_view name;
  std::string_view summary;
  NoiseModel draw;
};

/// All noise models. A new one is a file and a line in the registry.
std::span<const NoiseEntry> noise_registry();

/// Measures every range from the true position: m_j = |p_j - truth| + sigma_m * error_j.
void measure_ranges(const NoiseEntry& noise, double sigma_m, const core::Stream& stream, std::uint64_t first_trial,
                    core::ProblemBatch& problems);

}  // namespace ridgeloc::sim
