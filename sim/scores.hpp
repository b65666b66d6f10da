#pragma once

#include <cstdint>

#include "core/problem.hpp"
#include "core/random.hpp"
#include "sim/noise_options.hpp"

namespace ridgeloc::sim {

/// 1 / sqrt(E s^2c) for s uniform on [low, 1]: what keeps the root mean square of errors that are multiplied by s^c.
double score_error_scale(const ScoreOptions& options);

/// By what the error of a point with score s is multiplied; `scale` is `score_error_scale(options)`.
template <class Real>
Real score_error_factor(const ScoreOptions& options, double scale, const Real& score) {
  return Real(scale) * core::exp(Real(options.error_exponent) * core::log(score));
}

/// Writes the scores of trials first_trial, first_trial + 1, ... into `problems`, which have room for them
/// (`add_scores`). The score of a point depends on trial and point alone. Points 2i and 2i + 1 share random block i.
template <class Real = double>
[[gnu::flatten]] void draw_scores(const ScoreOptions& options, const core::Stream& stream, std::uint64_t first_trial,
                                  core::ProblemBatch& problems) {
  using Words = core::Words<Real>;
  const auto score = [&](const Real& u) { return core::mul_add(Real(1.0 - options.low), u, Real(options.low)); };
  for (std::size_t slot = 0; slot < problems.trials(); slot += core::lanes<Real>) {
    const Words trial = core::trial_words<Real>(first_trial + slot);
    for (std::size_t j = 0; j < problems.points(); j += 2) {
      const auto u = core::uniform_pair<Real>(stream.block(trial, Words(j / 2)));
      core::store_column(problems.score(j), slot, score(u[0]));
      if (j + 1 < problems.points()) core::store_column(problems.score(j + 1), slot, score(u[1]));
    }
  }
}

}  // namespace ridgeloc::sim
