#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "results/schema/schema.hpp"
#include "results/statistics/statistics.hpp"
#include "studies/study/experiment.hpp"
#include "studies/study/replay.hpp"

/// What an experiment may offer beside the contract that all have. An experiment, or the simulations it prepares,
/// derive from what they offer; whoever wants to use it asks with `offered`, or with `required` if a user has asked for
/// it.
namespace ridgeloc::studies {

/// Of an experiment: solvers that a [[method]] of a study may name.
class SolverChoice {
 public:
  static constexpr std::string_view what = "choice of solvers";
  virtual ~SolverChoice() = default;
  virtual std::vector<std::string> solvers() const = 0;
  virtual std::vector<std::string> settings_of_solver(std::string_view solver) const = 0;
};

/// Of an experiment: metrics that come from a reference which solves some of the trials again.
class ReferenceAudit {
 public:
  static constexpr std::string_view what = "audit by a reference";
  virtual ~ReferenceAudit() = default;
  /// How many of the metrics are reported only if there is an audit.
  virtual std::size_t audit_metrics() const = 0;
};

/// Of an experiment: what figures may show of the bounds of metrics in a cell.
class Yardsticks {
 public:
  static constexpr std::string_view what = "bound";
  virtual ~Yardsticks() = default;
  virtual results::BoundKind bound(const Values& cell) const = 0;
};

/// Of an experiment: what is worth a word about the settings of a cell, though they can stand.
class Remarks {
 public:
  static constexpr std::string_view what = "remarks";
  virtual ~Remarks() = default;
  virtual std::vector<std::string> remarks(const Values& cell) const = 0;
};

/// Of an experiment: what trials cost, where that is not the same for all.
class TrialCost {
 public:
  static constexpr std::string_view what = "cost of a trial";
  virtual ~TrialCost() = default;
  /// What the trials of one method in a cell have cost, in a unit that no machine changes.
  virtual double cost(const Values& cell, const results::Statistics& statistics) const = 0;
};

/// What the reference makes of the trials on which a method failed.
struct FailureCounts {
  std::uint64_t trials = 0;
  std::uint64_t failed = 0;
  std::uint64_t from_start = 0;  ///< of those: the reference finds a minimum from the same start
  std::uint64_t from_truth = 0;  ///< ... from the truth
  bool has_reference = false;
};

/// Of a simulation: trials that failed, given to a reference.
class FailureRecount {
 public:
  static constexpr std::string_view what = "recount of failures";
  virtual ~FailureRecount() = default;
  /// Simulates and solves the same trials again and gives those that failed to the reference, a count per method.
  virtual std::vector<FailureCounts> count_failures(TrialRange range, Workspace& workspace) const = 0;
};

/// Of a simulation: one trial told in full.
class TrialReplay {
 public:
  static constexpr std::string_view what = "replay of a trial";
  virtual ~TrialReplay() = default;
  /// Simulates one trial again and solves it with every method, over `double` with each iteration told, and beside it
  /// as in a block. A pure function, like `run_block`; the drawing takes a moment.
  virtual Replay replay(std::uint64_t trial, Workspace& workspace) const = 0;
};

/// What an experiment or a simulation offers, or null.
template <class Capability, class Object>
const Capability* offered(const Object& object) {
  return dynamic_cast<const Capability*>(&object);
}

/// Throws core::InputError: the experiment offers no such thing.
[[noreturn]] void refuse_missing(const Experiment& experiment, std::string_view what);

/// What a simulation of the experiment offers. Throws core::InputError, in one line, where it does not.
template <class Capability>
const Capability& required(const Experiment& experiment, const Simulation& simulation) {
  const auto* found = offered<Capability>(simulation);
  if (found == nullptr) refuse_missing(experiment, Capability::what);
  return *found;
}

// What is true where a capability is missing.

/// Solvers that a [[method]] may name; none without a choice.
std::vector<std::string> solvers_of(const Experiment& experiment);

/// Settings that a solver, or what a label of the experiment stands for, reads.
std::vector<std::string> settings_read_for(const Experiment& experiment, std::string_view name);

/// Names of the labels of an experiment.
std::vector<std::string> label_names(const Experiment& experiment);

/// 0 without an audit.
std::size_t audit_metrics_of(const Experiment& experiment);

/// `BoundKind::None` without yardsticks.
results::BoundKind bound_of(const Experiment& experiment, const Values& cell);

/// None without remarks.
std::vector<std::string> remarks_on(const Experiment& experiment, const Values& cell);

/// The number of trials, where no other cost is known.
double cost_of(const Experiment& experiment, const Values& cell, const results::Statistics& statistics);

}  // namespace ridgeloc::studies
