#include "studies/measured/epoch_solver.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/status.hpp"
#include "solvers/kernels/trace.hpp"
#include "studies/ranging/ranging_settings.hpp"
#include "studies/solving/solver_settings.hpp"

namespace ridgeloc::studies {

namespace {

/// How much of its standard deviation a position may still have to go.
constexpr double settled = 0.1;

/// Where coordinates of an epoch are taken from.
const Place& origin_of(const Epoch& epoch) {
  return epoch.readings.front().at;
}

}  // namespace

EpochSolver::EpochSolver(const Study& study, Known known, core::Isa isa) : known_(known), isa_(isa) {
  if (study.experiment->name() != "ranging") {
    throw core::InputError(
        fmt::format("measured ranges are solved with the methods of a study of \"ranging\"; \"{}\" is "
                    "one of \"{}\"",
                    study.name, study.experiment->name()));
  }
  if (!study.sweep.empty()) {
    const std::string& swept = study.sweep.front().setting->name;
    throw core::InputError(
        fmt::format("the study \"{}\" sweeps {}, and measured ranges are solved with one value of it: "
                    "give the methods in a study without [sweep], or as --solver",
                    study.name, swept));
  }
  const RangingCell cell(study.fixed);
  if (cell.has_images)
    throw core::InputError("scene.model = \"pseudorange\" is about photos; measured ranges need model = \"range\"");
  knows_height_ = cell.knows_height;
  if (knows_height_ && !known_.start)
    throw core::InputError("scene.z_mode = \"fixed\": the height is that of --start X,Y,Z; give one");
  for (const Method& method : study.methods) {
    solvers::SolverOptions options = solver_options(study.fixed, method.given);
    if (known_.start && !knows_height_) options.start = solvers::Start::Given;
    const auto& entry = solvers::solver_named(method.solver);
    const auto& estimator = solvers::k_estimator_registry()[options.k];
    if (entry.has_k && estimator.needs_oracle) {
      throw core::InputError(
          fmt::format("k = \"{}\" of method \"{}\" needs the true position, which measured data do not "
                      "have; choose another (ridgeloc list k)",
                      estimator.name, method.label));
    }
    methods_.push_back({method.label, method.solver, options});
  }
}

std::vector<std::vector<Fix>> EpochSolver::solve(std::span<const Epoch> epochs,
                                                 std::span<const EpochGeometry> geometries) {
  std::vector<std::vector<Fix>> fixes(methods_.size(), std::vector<Fix>(epochs.size()));
  std::map<std::size_t, std::vector<std::size_t>> by_readings;
  for (std::size_t e = 0; e < epochs.size(); ++e) {
    if (geometries[e].is_solvable) {
      by_readings[epochs[e].readings.size()].push_back(e);
    } else {
      for (auto& of_method : fixes) of_method[e].status = "too_few_objects";
    }
  }
  for (const auto& [readings, some] : by_readings) {
    fill(epochs, geometries, some);
    for (std::size_t m = 0; m < methods_.size(); ++m) {
      const SolvedMethod& method = methods_[m];
      solvers::solver_named(method.solver).kernel(isa_)(problems_, method.options, nullptr, solutions_);
      for (std::size_t slot = 0; slot < some.size(); ++slot)
        fixes[m][some[slot]] = fix_of(method, epochs[some[slot]], slot);
    }
  }
  return fixes;
}

void EpochSolver::fill(std::span<const Epoch> epochs, std::span<const EpochGeometry> geometries,
                       std::span<const std::size_t> some) {
  const std::size_t readings = epochs[some.front()].readings.size();
  problems_.reshape(readings, some.size());
  const bool has_scores = std::ranges::any_of(some, [&](std::size_t e) {
    return std::ranges::any_of(epochs[e].readings, [](const Reading& reading) { return reading.score != 1.0; });
  });
  if (has_scores) problems_.add_scores();
  for (std::size_t slot = 0; slot < some.size(); ++slot) {
    const Epoch& epoch = epochs[some[slot]];
    const Place& origin = origin_of(epoch);
    const Place& start = known_.start ? *known_.start : geometries[some[slot]].start;
    for (std::size_t axis = 0; axis < origin.size(); ++axis) {
      problems_.start(axis)[slot] = start[axis] - origin[axis];
      for (std::size_t j = 0; j < readings; ++j)
        problems_.position(j, axis)[slot] = epoch.readings[j].at[axis] - origin[axis];
    }
    for (std::size_t j = 0; j < readings; ++j) {
      problems_.measured(j)[slot] = epoch.readings[j].range_m;
      if (has_scores) problems_.score(j)[slot] = epoch.readings[j].score;
    }
  }
}

Fix EpochSolver::fix_of(const SolvedMethod& method, const Epoch& epoch, std::size_t slot) const {
  Fix fix;
  fix.status = core::status_names[solutions_.status[slot]];
  fix.iterations = solutions_.iterations[slot];
  // Residuals near the origin too, where a difference of positions is as exact as they are.
  Epoch local = epoch;
  Place position{};
  for (std::size_t axis = 0; axis < position.size(); ++axis) {
    position[axis] = solutions_.estimate[axis][slot];
    for (Reading& reading : local.readings) reading.at[axis] -= origin_of(epoch)[axis];
  }
  double squares = 0.0;
  for (const Reading& reading : local.readings) {
    const double computed =
        std::hypot(position[0] - reading.at[0], position[1] - reading.at[1], position[2] - reading.at[2]);
    fix.residuals_m.push_back(reading.range_m - computed);
    squares += fix.residuals_m.back() * fix.residuals_m.back();
  }
  fix.residual_rms_m = std::sqrt(squares / static_cast<double>(local.readings.size()));
  // A short step may be a damped one, or lead elsewhere than to the minimum of the weighted squares, for which alone
  // the covariance holds.
  if (solutions_.status[slot] == static_cast<std::uint8_t>(core::Status::Converged)) {
    const auto iterates = solvers::trace(method.solver, problems_, slot, method.options, nullptr);
    fix.uncertainty =
        uncertainty_of(local, position, iterates.back().weights, fix.residuals_m, knows_height_, known_.sigma_m);
    const double left_m = solutions_.remaining_step_m[slot];
    auto& covariance = fix.uncertainty.covariance;
    fix.is_settled =
        left_m <= method.options.step_tolerance_m ||
        (covariance && left_m <= settled * std::sqrt((*covariance)[0] + (*covariance)[3] + (*covariance)[5]));
    if (!fix.is_settled) covariance.reset();
  }
  for (std::size_t axis = 0; axis < position.size(); ++axis) position[axis] += origin_of(epoch)[axis];
  fix.position = position;
  return fix;
}

}  // namespace ridgeloc::studies
