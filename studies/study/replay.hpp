#pragma once

#include <string>
#include <variant>
#include <vector>

#include "results/pictures/drawing.hpp"
#include "results/pictures/floor_plan.hpp"
#include "results/tables/data_table.hpp"

namespace ridgeloc::studies {

/// What one method made of a trial.
struct ReplayedMethod {
  std::string label;
  std::string solver;
  std::vector<results::DataTable> tables;  ///< its iterations, how it ended, and what else there is to compare
};

/// One trial told in full.
struct Replay {
  std::vector<results::DataTable> scene;                       ///< what was simulated
  std::vector<ReplayedMethod> methods;                         ///< in the order asked for
  std::variant<results::Drawing, results::FloorPlan> drawing;  ///< without a title
};

}  // namespace ridgeloc::studies
