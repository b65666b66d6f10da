#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/isa.hpp"
#include "results/blocks/block.hpp"
#include "results/schema/schema.hpp"
#include "studies/study/replay.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

/// One method of a study: a solver with the settings that the study file gives it.
struct Method {
  std::string label;
  std::string solver;
  Values given;
};

/// One point of the sweep grid: the value of every setting of the experiment, swept ones included.
struct Cell {
  std::size_t index = 0;
  std::string hash;                  ///< of the swept values
  std::vector<std::size_t> indices;  ///< per axis
  Values values;
};

/// Trials first, first + 1, ..., first + count - 1 of a cell.
struct TrialRange {
  std::uint64_t first = 0;
  std::size_t count = 0;
};

/// What of a study, besides cell and methods, its numbers depend on.
struct StudyKey {
  std::uint64_t seed = 0;
  double audit = 0.0;  ///< `Study::audit`

  StudyKey(std::uint64_t study_seed, double audit_share = 0.0) : seed(study_seed), audit(audit_share) {}
};

/// Scratch memory of one thread, kept from block to block, and the instruction set that the thread computes with.
class Workspace {
 public:
  explicit Workspace(core::Isa set) : isa(set) {}
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  virtual ~Workspace() = default;

  const core::Isa isa;
};

/// What the reference makes of the trials on which a method failed.
struct FailureCounts {
  std::uint64_t trials = 0;
  std::uint64_t failed = 0;
  std::uint64_t from_start = 0;  ///< of those: the reference finds a minimum from the same start
  std::uint64_t from_truth = 0;  ///< ... from the truth
  bool has_reference = false;
};

/// A kind of simulated experiment. The runner, the store, the statistics and the figures know this interface alone, so
/// a new experiment is one file and a line in the registry.
class Experiment {
 public:
  Experiment() = default;
  Experiment(const Experiment&) = delete;
  Experiment& operator=(const Experiment&) = delete;
  virtual ~Experiment() = default;

  virtual std::string_view name() const = 0;
  virtual std::string_view summary() const = 0;

  /// Raised whenever a change of the code alters numbers; part of the study hash.
  virtual int version() const = 0;

  /// Trials per block.
  virtual std::uint64_t block_trials() const = 0;

  virtual std::span<const Setting> settings() const = 0;
  virtual const results::Schema& schema() const = 0;

  /// Refuses settings of a cell that cannot stand together: throws core::InputError that says which and why.
  virtual void check(const Values& cell) const = 0;

  /// What figures may show of the bounds of metrics in a cell; nothing where they are none.
  virtual results::BoundKind bound(const Values&) const { return results::BoundKind::None; }

  /// What the trials of one method in a cell have cost, in a unit that no machine changes.
  virtual double cost(const Values&, const results::Statistics& statistics) const {
    return static_cast<double>(statistics.trials);
  }

  /// How many of the metrics are reported only if there is an audit.
  virtual std::size_t audit_metrics() const { return 0; }

  /// The end of a template study: a [sweep], [[method]]s and a [[figure]] worth starting from.
  virtual std::string_view example() const = 0;

  /// Solvers that a [[method]] may name, and which settings each of them, or what an extra label stands for, reads.
  virtual std::vector<std::string> solvers() const = 0;
  virtual std::vector<std::string> settings_of_solver(std::string_view solver) const = 0;

  /// Labels of what the experiment reports beside the methods, after them in the order of columns.
  virtual std::vector<std::string> extra_labels() const = 0;

  /// Scratch memory for one thread. Precondition: core::is_supported(isa).
  virtual std::unique_ptr<Workspace> make_workspace(core::Isa isa) const = 0;

  /// Simulates and solves a range of trials of one cell and hands every column to `sink`. A pure function of (key,
  /// cell, methods, range, instruction set): no clock, no thread, no state between calls. Thread safe for distinct
  /// workspaces.
  virtual void run_block(const StudyKey& key, const Cell& cell, std::span<const Method> methods, TrialRange range,
                         Workspace& workspace, results::BlockSink& sink) const = 0;

  /// Simulates and solves the same trials again and gives those that failed to the reference, a count per method.
  virtual std::vector<FailureCounts> count_failures(std::uint64_t seed, const Cell& cell,
                                                    std::span<const Method> methods, TrialRange range,
                                                    Workspace& workspace) const = 0;

  /// Simulates one trial again and solves it with every method, over `double` with each iteration told, and beside it
  /// as in a block. A pure function, like `run_block`; the drawing takes a moment.
  virtual Replay replay(std::uint64_t seed, const Cell& cell, std::span<const Method> methods, std::uint64_t trial,
                        Workspace& workspace) const = 0;
};

/// All experiments.
std::span<const Experiment* const> experiment_registry();

/// The experiment of that name, or null.
const Experiment* find_experiment(std::string_view name);

}  // namespace ridgeloc::studies
