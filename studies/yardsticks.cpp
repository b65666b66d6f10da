#include "studies/yardsticks.hpp"

#include <cmath>
#include <limits>

#include "core/matrix3.hpp"
#include "solvers/least_squares.hpp"

namespace ridgeloc::studies {

void dilution_of_precision(const core::ProblemBatch& problems, const std::array<double, 3>& truth,
                           std::span<double> gdop) {
  for (std::size_t trial = 0; trial < problems.trials(); ++trial) {
    const solvers::RangeModel<double> model(problems, trial);
    const core::Symmetric3<double> normal = solvers::least_squares_equations(model, truth).matrix;
    double trace = 0.0;
    bool singular = false;
    for (std::size_t i = 0; i < 3; ++i) {
      core::Vector3<double> unit{};
      unit[i] = 1.0;
      const auto column = core::solve(normal, unit);
      trace += column.x[i];
      singular = singular || column.singular;
    }
    gdop[trial] = singular ? std::numeric_limits<double>::infinity() : std::sqrt(trace);
  }
}

}  // namespace ridgeloc::studies
