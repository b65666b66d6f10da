#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/problem.hpp"
#include "core/random.hpp"
#include "sim/noise_options.hpp"

namespace ridgeloc::sim {

/// Independent standard normal errors. Points 2i and 2i + 1 share random block i.
struct NormalNoise {
  static constexpr std::string_view name = "normal";
  static constexpr std::string_view summary = "independent normal errors";
  static constexpr std::array<std::string_view, 0> option_names{};

  const NoiseOptions& options;

  template <class Real>
  [[gnu::flatten]] void draw(const core::Stream& noise, std::uint64_t first_trial, core::ProblemBatch& problems) const {
    using Words = core::Words<Real>;
    for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
      const Words trial = core::trial_words<Real>(first_trial + slot);
      for (std::size_t j = 0; j < problems.points(); j += 2) {
        const auto errors = core::normal_pair(core::uniform_pair<Real>(noise.block(trial, Words(j / 2))));
        core::store_column(problems.measured(j), slot, errors[0]);
        if (j + 1 < problems.points()) core::store_column(problems.measured(j + 1), slot, errors[1]);
      }
    }
  }
};

}  // namespace ridgeloc::sim
