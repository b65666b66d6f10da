#include "sim/scores.hpp"

namespace ridgeloc::sim {

double score_error_scale(const ScoreOptions& options) {
  // Exactly 1, so that scores that say nothing leave every bit of the errors alone.
  if (options.error_exponent == 0.0 || options.low == 1.0) return 1.0;
  // E s^2c = (1 - low^m) / (m (1 - low)), m = 2c + 1; for m = 0 the limit, -log(low) / (1 - low).
  const double m = 2.0 * options.error_exponent + 1.0;
  const double log_low = core::log(options.low);
  const double integral = m == 0.0 ? -log_low : -core::exp_minus_one(m * log_low) / m;
  return core::sqrt((1.0 - options.low) / integral);
}

}  // namespace ridgeloc::sim
