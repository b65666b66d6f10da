#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>

#include "core/problem.hpp"
#include "core/registry.hpp"
#include "core/stream.hpp"
#include "sim/contaminated_noise.hpp"
#include "sim/empirical_noise.hpp"
#include "sim/noise_options.hpp"
#include "sim/normal_noise.hpp"
#include "sim/proportional_noise.hpp"
#include "sim/scores.hpp"
#include "sim/student_t_noise.hpp"
#include "sim/true_range.hpp"

namespace ridgeloc::sim {

/// The noise models. Each draws the errors of all observations, in units of their level, into the measured ranges of a
/// batch; error j of a trial depends on the trial, point j and the model's options alone, never on the noise level or
/// the number of points. A new one is a file with its class and a line here.
using NoiseModels = std::tuple<NormalNoise, StudentTNoise, ContaminatedNoise, ProportionalNoise, EmpiricalNoise>;

/// A noise model as users see it.
struct NoiseEntry {
  std::string_view name;
  std::string_view summary;
  std::span<const std::string_view> options;  ///< settings that it reads besides `range_sigma_m`
  std::size_t index;                          ///< in `NoiseModels`
};
std::span<const NoiseEntry> noise_registry();

/// The noise model of that name, or null.
const NoiseEntry* find_noise(std::string_view name);

/// Measures every range from the true position: m_j = |p_j - truth| + range_sigma_m * error_j. Scores that the problems
/// have scale the errors.
template <class Real = double>
[[gnu::flatten]] void measure_ranges(const NoiseEntry& noise, const NoiseOptions& options, const core::Stream& stream,
                                     std::uint64_t first_trial, core::ProblemBatch& problems) {
  core::with_entry<NoiseModels>(
      noise.index, [&](auto model) { model.template draw<Real>(stream, first_trial, problems); }, options);
  const bool scored = problems.has_scores();
  const double scale = scored ? score_error_scale(options.score) : 1.0;
  for (std::size_t j = 0; j < problems.points(); ++j) {
    for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
      Real error = core::load_column<Real>(problems.measured(j), slot);
      if (scored) {
        const Real score = core::load_column<Real>(problems.score(j), slot);
        error = error * score_error_factor(options.score, scale, score);
      }
      const Real range = true_range<Real>(problems, j, slot);
      core::store_column(problems.measured(j), slot, core::mul_add(Real(options.range_sigma_m), error, range));
    }
  }
}

}  // namespace ridgeloc::sim
