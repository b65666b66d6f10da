#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>

#include "core/matrix.hpp"
#include "core/problem.hpp"
#include "core/registry.hpp"
#include "core/stream.hpp"
#include "sim/field_of_view.hpp"
#include "sim/normal_noise.hpp"

namespace ridgeloc::sim {

/// The noise models. Each draws the errors of all observations, in units of their standard deviation, into the measured
/// ranges of a batch; error j of a trial depends on the trial and j alone, never on the noise level or the number of
/// points. A new one is a file with its class and a line here.
using NoiseModels = std::tuple<NormalNoise>;

/// A noise model as users see it.
struct NoiseEntry {
  std::string_view name;
  std::string_view summary;
  std::size_t index;  ///< in `NoiseModels`
};
std::span<const NoiseEntry> noise_registry();

/// Measures every range from the true position: m_j = |p_j - truth| + sigma_m * error_j.
template <class Real = double>
[[gnu::flatten]] void measure_ranges(const NoiseEntry& noise, double sigma_m, const core::Stream& stream,
                                     std::uint64_t first_trial, core::ProblemBatch& problems) {
  core::with_entry<NoiseModels>(noise.index,
                                [&](auto model) { model.template draw<Real>(stream, first_trial, problems); });
  for (std::size_t j = 0; j < problems.points(); ++j) {
    for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
      core::Vector3<Real> d;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        d[axis] = core::load_column<Real>(problems.position(j, axis), slot) - Real(true_position_m[axis]);
      }
      const Real error = core::load_column<Real>(problems.measured(j), slot);
      core::store_column(problems.measured(j), slot, core::mul_add(Real(sigma_m), error, core::sqrt(core::dot(d, d))));
    }
  }
}

}  // namespace ridgeloc::sim
