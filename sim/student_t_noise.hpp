#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "core/problem.hpp"
#include "core/random.hpp"
#include "sim/noise_options.hpp"

namespace ridgeloc::sim {

/// Independent errors of Student's t distribution with nu > 2 degrees of freedom, whole or not, scaled from its
/// standard deviation sqrt(nu / (nu - 2)) to 1. Point j uses random block j.
///
/// Bailey's polar method (1994): t = sqrt(nu (u0^(-2/nu) - 1)) cos(2 pi u1) is exact and rejects nothing. Sine and
/// cosine of one angle would be uncorrelated but not independent, so a block gives one error.
struct StudentTNoise {
  static constexpr std::string_view name = "student_t";
  static constexpr std::string_view summary = "independent errors of Student's t distribution: heavy tails";
  static constexpr std::array<std::string_view, 1> option_names = {"noise_dof"};

  const NoiseOptions& options;

  template <class Real>
  [[gnu::flatten]] void draw(const core::Stream& noise, std::uint64_t first_trial, core::ProblemBatch& problems) const {
    using Words = core::Words<Real>;
    for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
      const Words trial = core::trial_words<Real>(first_trial + slot);
      for (std::size_t j = 0; j < problems.points(); ++j) {
        const auto u = core::uniform_pair<Real>(noise.block(trial, Words(j)));
        const Real power = core::exp_minus_one(Real(-2.0 / options.dof) * core::log(u[0]));
        const Real radius = core::sqrt(Real(options.dof - 2.0) * power);
        core::store_column(problems.measured(j), slot, radius * core::sin_cos_turns(u[1]).cos);
      }
    }
  }
};

}  // namespace ridgeloc::sim
