#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/problem.hpp"
#include "core/random.hpp"
#include "sim/noise_options.hpp"
#include "sim/normal_noise.hpp"
#include "sim/true_range.hpp"

namespace ridgeloc::sim {

/// Independent normal errors of standard deviation r_j / `reference_depth_m`, r_j the true range of point j.
struct ProportionalNoise {
  static constexpr std::string_view name = "proportional";
  static constexpr std::string_view summary = "normal errors whose standard deviation grows with the range";
  static constexpr std::array<std::string_view, 1> option_names = {"reference_depth_m"};

  const NoiseOptions& options;

  template <class Real>
  [[gnu::flatten]] void draw(const core::Stream& noise, std::uint64_t first_trial, core::ProblemBatch& problems) const {
    NormalNoise{options}.draw<Real>(noise, first_trial, problems);
    const Real per_metre(1.0 / options.reference_depth_m);
    for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
      for (std::size_t j = 0; j < problems.points(); ++j) {
        const Real error = core::load_column<Real>(problems.measured(j), slot);
        core::store_column(problems.measured(j), slot, error * (true_range<Real>(problems, j, slot) * per_metre));
      }
    }
  }
};

}  // namespace ridgeloc::sim
