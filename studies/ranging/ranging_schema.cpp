#include "studies/ranging/ranging_schema.hpp"

#include <string>
#include <string_view>
#include <utility>

#include "core/problem.hpp"
#include "core/status.hpp"

namespace ridgeloc::studies::ranging {

namespace {

results::Schema make_schema() {
  results::Schema schema;
  schema.metrics = {
      {"error_m", "m", "position error of converged trials", false},
      {"error_all_m", "m", "position error of all trials", true},
      {"iterations", "1", "iterations, a failed trial counting the limit", false, true},
      {"eta_first", "1", "similarity of K to the true K at the first iteration", false},
      {"eta_last", "1", "similarity of K to the true K at the last iteration", false},
      {"eta_mean", "1", "similarity of K to the true K averaged over the iterations", false},
      {"residual_rms_m", "m", "root mean square residual of converged trials", false},
      {"crb_m", "m", "Cramer-Rao bound of unbiased position estimates", true},
      {"gdop", "1", "geometric dilution of precision", true},
      {"condition", "1", "condition number of J'J at the truth", true},
      {"squared_error_m2", "m2", "squared position error of all trials", true},
      {"error_x_m", "m", "signed position error of all trials along the optical axis", true},
  };
  for (const Metric compared : {ErrorM, ErrorAllM, SquaredErrorM2, Iterations})
    schema.metrics[compared].is_compared = true;
  for (const Metric bounded : {ErrorM, ErrorAllM}) schema.metrics[bounded].bound = schema.metrics[CrbM].name;
  for (results::MetricInfo& metric : studies::audit_metrics()) schema.metrics.push_back(std::move(metric));
  schema.metrics.push_back({"nees", "1", "normalized squared position error of converged trials", false});
  schema.metrics[Nees].chi_square = core::position_parameters;
  for (const std::string_view status : core::status_names) {
    const bool is_failure = status != core::status_names[static_cast<std::size_t>(core::Status::Converged)];
    schema.events.push_back({std::string(status), "trials that ended as " + std::string(status), is_failure});
  }
  schema.statuses = schema.events.size();
  // A small |J'We| alone would not tell a solver that has arrived from one that is held back where J'WJ is small; the
  // step that it leads to without K or damping does.
  schema.events.push_back(
      {"stationary", "converged trials whose next step without K or damping is shorter than the step tolerance"});
  return schema;
}

}  // namespace

const results::Schema& schema() {
  static const results::Schema schema = make_schema();
  return schema;
}

}  // namespace ridgeloc::studies::ranging
