#pragma once

#include <span>

namespace ridgeloc::sim {

/// How detection scores are drawn, and what they say about the errors: the error of a point with score s is multiplied
/// by s^c / sqrt(E s^2c), c = `error_exponent`, which leaves the root mean square of all errors as it was.
struct ScoreOptions {
  double low = 0.2;              ///< scores are uniform on [low, 1], 0 < low <= 1
  double error_exponent = -1.0;  ///< c: negative where a high score means an accurate range, 0 where it means nothing
};

/// What noise models read. Each uses what its `option_names` say and ignores the rest.
struct NoiseOptions {
  double range_sigma_m = 0.1;            ///< level of the errors; every model states what of
  double dof = 3.0;                      ///< `student_t`: degrees of freedom, above 2
  double outlier_rate = 0.1;             ///< `contaminated`: probability of an outlier
  double outlier_size = 10.0;            ///< `contaminated`: by how much outliers are larger
  double reference_depth_m = 5.0;        ///< `proportional`: where the standard deviation is `range_sigma_m`
  std::span<const double> samples = {};  ///< `empirical`: what is drawn from, not empty
  double samples_rms = 1.0;              ///< `empirical`: their root mean square, above 0
  ScoreOptions score = {};               ///< read where problems have scores
};

}  // namespace ridgeloc::sim
