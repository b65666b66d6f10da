#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/problem.hpp"
#include "core/random.hpp"
#include "sim/noise_options.hpp"

namespace ridgeloc::sim {

/// Errors drawn with replacement from samples that are given, scaled to a root mean square of 1 but not centred: a bias
/// of the samples stays. Points 2i and 2i + 1 share random block i. Which samples are drawn depends on their number
/// alone.
struct EmpiricalNoise {
  static constexpr std::string_view name = "empirical";
  static constexpr std::string_view summary = "errors drawn with replacement from given samples";
  static constexpr std::array<std::string_view, 1> option_names = {"noise_samples"};

  const NoiseOptions& options;

  template <class Real>
  [[gnu::flatten]] void draw(const core::Stream& noise, std::uint64_t first_trial, core::ProblemBatch& problems) const {
    using Words = core::Words<Real>;
    const Real scale(1.0 / options.samples_rms);
    const Real count(static_cast<double>(options.samples.size()));
    // u < 1 keeps u n below n, rounded too: the largest u, 1 - 2^-53, lies more than half a step of n below it.
    const auto pick = [&](const Real& u) { return core::look_up(options.samples.data(), u * count) * scale; };
    for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
      const Words trial = core::trial_words<Real>(first_trial + slot);
      for (std::size_t j = 0; j < problems.points(); j += 2) {
        const auto u = core::uniform_pair<Real>(noise.block(trial, Words(j / 2)));
        core::store_column(problems.measured(j), slot, pick(u[0]));
        if (j + 1 < problems.points()) core::store_column(problems.measured(j + 1), slot, pick(u[1]));
      }
    }
  }
};

}  // namespace ridgeloc::sim
