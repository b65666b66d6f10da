#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <vector>

#include "studies/plan/plan.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// What the workers of a queue need to compute blocks of a study: a workspace each, kept from block to block, and the
/// simulations, which those share that work on the same cell. A simulation lives as long as a worker may go on with it,
/// so that memory does not grow with the number of cells.
///
/// `workspace` and `simulation` may be called by different workers at the same time. Study and plan must outlive it.
class Workbench {
 public:
  Workbench(const Study& study, const Plan& plan, std::size_t workers);

  Workspace& workspace(std::size_t worker);

  /// The simulation of a cell for some methods of the study. Valid until the worker asks for the next.
  const Simulation& simulation(std::size_t worker, std::size_t cell, std::span<const Method> methods);

 private:
  /// A cell and the labels of the methods.
  using Key = std::pair<std::size_t, std::vector<std::string>>;
  struct Place {
    std::unique_ptr<Workspace> workspace;
    Key key;
    std::shared_ptr<const Simulation> simulation;
  };

  /// A simulation that is made by the first who asks while those wait who ask for the same.
  struct Shared {
    std::mutex mutex;
    std::weak_ptr<const Simulation> simulation;
  };

  std::shared_ptr<Shared> shared_of(const Key& key);
  std::shared_ptr<const Simulation> prepared(const Key& key, std::span<const Method> methods);

  const Study& study_;
  const Plan& plan_;
  std::vector<Place> places_;  ///< by worker
  std::mutex mutex_;           ///< guards the map
  std::map<Key, std::shared_ptr<Shared>> shared_;
};

}  // namespace ridgeloc::studies
