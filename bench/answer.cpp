#include "bench/answer.hpp"

#include <algorithm>
#include <cmath>

#include "sim/field_of_view.hpp"

namespace ridgeloc::bench {

double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) {
  return std::hypot(a[0] - b[0], a[1] - b[1], a[2] - b[2]);
}

Accuracy accuracy(std::span<const Answer> answers) {
  Accuracy sum{};
  for (const Answer& answer : answers) {
    const double error = distance(answer.estimate, sim::true_position_m);
    const double clipped = error < clip_m ? error : clip_m;  // clips an estimate that is not a number, too
    sum.steps += answer.steps;
    sum.rms_error_m += clipped * clipped;
    sum.converged += answer.converged ? 1.0 : 0.0;
  }
  const double trials = static_cast<double>(answers.size());
  return {sum.steps / trials, std::sqrt(sum.rms_error_m / trials), sum.converged / trials};
}

}  // namespace ridgeloc::bench
