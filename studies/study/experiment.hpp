#pragma once

#include <cassert>
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
#include "studies/study/monitor.hpp"
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

/// Scratch memory of one thread, kept from block to block, and the instruction set that the thread computes with. An
/// experiment that keeps anything derives from it.
class Workspace {
 public:
  explicit Workspace(core::Isa set) : isa(set) {}
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;
  virtual ~Workspace() = default;

  const core::Isa isa;
};

/// A workspace as the experiment that made it knows it.
template <class Own>
Own& own(Workspace& workspace) {
  assert(dynamic_cast<Own*>(&workspace) != nullptr);
  return static_cast<Own&>(workspace);
}

/// One cell with some methods, ready to be run: whatever all its blocks share. Immutable, and shared by all threads.
class Simulation {
 public:
  Simulation() = default;
  Simulation(const Simulation&) = delete;
  Simulation& operator=(const Simulation&) = delete;
  virtual ~Simulation() = default;

  /// Simulates and solves a range of trials and hands every column to `sink`: those of the methods, then those of the
  /// labels of the experiment. A pure function of what the simulation was prepared from, the range and the instruction
  /// set: no clock, no thread, no state between calls. A trial that fails is a status; nothing is thrown because of
  /// one. Thread safe for distinct workspaces of the experiment.
  ///
  /// Returns whether it came to its end. It does not if the monitor asked to stop: the sink is then of no use.
  [[nodiscard]] virtual bool run_block(TrialRange range, Workspace& workspace, Monitor& monitor,
                                       results::BlockSink& sink) const = 0;
};

/// What an experiment reports beside the methods of a study, and which settings that depends on besides those that
/// every method shares.
struct Label {
  std::string name;
  std::vector<std::string> settings;
};

/// A kind of simulated experiment. Runner, store, statistics and figures know this contract alone, and it says only
/// what every experiment has; what some offer besides is in studies/study/capabilities.hpp. A new experiment is one
/// file and a line in the registry.
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

  /// Trials per block, the unit of work, of storing and of stopping: what takes some milliseconds, or one trial if that
  /// takes longer.
  virtual std::uint64_t block_trials() const = 0;

  virtual std::span<const Setting> settings() const = 0;
  virtual const results::Schema& schema() const = 0;

  /// The end of a template study: a [sweep], [[method]]s and a [[figure]] worth starting from.
  virtual std::string_view example() const = 0;

  /// Labels of what is reported beside the methods, after them in the order of columns.
  virtual std::vector<Label> labels() const { return {{std::string(name()), {}}}; }

  /// Refuses settings of a cell that cannot stand together: throws core::InputError that says which and why.
  virtual void check(const Values&) const {}

  /// Scratch memory for one thread. Precondition: core::is_supported(isa).
  virtual std::unique_ptr<Workspace> make_workspace(core::Isa isa) const { return std::make_unique<Workspace>(isa); }

  /// Makes what all blocks of a cell need. `methods` are empty for an experiment that offers no choice of solvers. The
  /// study must outlive the simulation, since large values (maps, samples) are shared with it; the cell need not.
  /// Throws core::InputError where the settings turn out to be impossible.
  virtual std::unique_ptr<const Simulation> prepare(const StudyKey& key, const Cell& cell,
                                                    std::span<const Method> methods) const = 0;
};

}  // namespace ridgeloc::studies
