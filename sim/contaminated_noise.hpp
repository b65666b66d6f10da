#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/problem.hpp"
#include "core/random.hpp"
#include "sim/noise_options.hpp"
#include "sim/normal_noise.hpp"

namespace ridgeloc::sim {

/// Standard normal errors, of which each is with probability `outlier_rate` an outlier: `outlier_size` times as large.
/// The level is the standard deviation of the others. Outliers are chosen by draws of their own, from `first_choice`
/// on, so that a higher rate only adds outliers and a rate of 0 leaves the normal errors of this stream.
struct ContaminatedNoise {
  static constexpr std::string_view name = "contaminated";
  static constexpr std::string_view summary = "normal errors, some of them many times as large: outliers";
  static constexpr std::array<std::string_view, 2> option_names = {"outlier_rate", "outlier_size"};
  static constexpr std::uint64_t first_choice = std::uint64_t{1} << 32;

  const NoiseOptions& options;

  template <class Real>
  [[gnu::flatten]] void draw(const core::Stream& noise, std::uint64_t first_trial, core::ProblemBatch& problems) const {
    using Words = core::Words<Real>;
    NormalNoise{options}.draw<Real>(noise, first_trial, problems);
    const Real rate(options.outlier_rate);
    const Real size(options.outlier_size);
    for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
      const Words trial = core::trial_words<Real>(first_trial + slot);
      const auto choose = [&](std::size_t j, const Real& u) {
        const Real error = core::load_column<Real>(problems.measured(j), slot);
        core::store_column(problems.measured(j), slot, core::select(u < rate, size * error, error));
      };
      for (std::size_t j = 0; j < problems.points(); j += 2) {
        const auto u = core::uniform_pair<Real>(noise.block(trial, Words(first_choice + j / 2)));
        choose(j, u[0]);
        if (j + 1 < problems.points()) choose(j + 1, u[1]);
      }
    }
  }
};

}  // namespace ridgeloc::sim
