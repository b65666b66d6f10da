#include "studies/yardsticks.hpp"

#include <cmath>
#include <limits>

#include "core/matrix3.hpp"
#include "solvers/normal_equations.hpp"

namespace ridgeloc::studies {

void dilution_of_precision(const core::ProblemBatch& problems, const std::array<double, 3>& truth,
                           std::span<double> gdop) {
  for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
    const solvers::RangeModel<double> model(problems, trial);
    solvers::NormalEquations<double> unweighted;
    for (std::size_t j = 0; j < problems.points(); ++j) unweighted.add(model.observe(j, truth), 1.0);
    double trace = 0.0;
    bool singular = false;
    for (std::size_t i = 0; i < 3; ++i) {
      core::Vector3<double> unit{};
      unit[i] = 1.0;
      const auto column = core::solve(unweighted.matrix, unit);
      trace += column.x[i];
      singular = singular || column.singular;
    }
    // Near singularity rounding can turn the trace of a positive definite inverse negative.
    gdop[trial] = singular || !(trace > 0.0) ? std::numeric_limits<double>::infinity() : std::sqrt(trace);
  }
}

}  // namespace ridgeloc::studies
