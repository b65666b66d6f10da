#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/problem.hpp"
#include "core/solution.hpp"
#include "core/status.hpp"
#include "sim/photo.hpp"
#include "solvers/coarse/coarse_matching.hpp"
#include "studies/building/building_outcome.hpp"
#include "studies/building/map_graphs.hpp"
#include "studies/photos/building_settings.hpp"
#include "studies/solving/pieces.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

/// What is known of one photo.
struct PhotoRecord {
  bool is_taken = true;  ///< false: among very many photos none showed what was asked for, and the rest says nothing
  std::array<double, 2> truth_m{};
  double image_distance_mm = 0.0;
  std::size_t visible = 0;
  std::size_t detections = 0;
  std::size_t starts = 0;
  double pseudorange_error_m = 0.0;  ///< mean |sqrt(alpha v^2 + rho) - r| of the detections, v the true one
  double coarse_error_m = 0.0;       ///< of the best coarse position; NaN without one
  double coarse_mean_error_m = 0.0;  ///< averaged over them
  double coarse_right = 0.0;         ///< share of them whose matched objects are all the true ones
};

/// A place that fine positioning starts from, with the objects that it takes for those of the photo.
struct StartRecord {
  std::uint32_t photo = 0;
  std::array<double, 2> place_m{};
  std::uint32_t first = 0;  ///< of its observations
  std::uint32_t points = 0;
};

/// Where a method ends from a start.
struct StartEnd {
  core::Status status = core::Status::NotRun;
  sim::PlanPoint place_m{};
  double iterations = 0.0;
};

/// A detection as the object it is taken for.
struct Observed {
  std::size_t object = 0;  ///< of the map
  sim::Pseudorange pseudorange;
  double score = 1.0;
};

/// Problems with the same number of points, one for each start.
struct StartGroup {
  std::size_t points = 0;
  std::vector<std::uint32_t> starts;  ///< indices
  core::ProblemBatch problems;
  std::array<std::vector<double>, core::position_parameters> truth;
  std::vector<double> image_distance;
};

/// How many photos to simulate together: of starts all over the map those of a whole block would fill gigabytes, and
/// whoever watches wants to see how far a block is.
std::size_t photos_at_once(const BuildingCell& settings);

/// Scratch memory of the `building` experiment.
struct BuildingScratch : Workspace {
  using Workspace::Workspace;

  sim::Photo photo;
  std::vector<PhotoRecord> photos;
  std::vector<StartRecord> starts;
  std::vector<Observed> observed;
  std::vector<StartGroup> groups;
  core::SolutionBatch solutions;
  PieceMemory piece;
  std::vector<StartEnd> ends;          ///< by start, of the method last solved with
  std::vector<PhotoOutcome> outcomes;  ///< by photo, likewise

  solvers::CoarseScratch coarse;
  std::vector<solvers::GraphNode> image;
  std::vector<solvers::CoarsePose> poses;

  // Of a block.
  std::vector<PhotoRecord> block_photos;
  std::vector<std::vector<PhotoOutcome>> block_outcomes;  ///< by method
  std::vector<double> values;
  std::vector<std::uint8_t> codes;
};

/// What all photos of a cell share. Valid as long as the cell.
struct BuildingScene {
  /// Throws core::InputError where a view shows more objects than a map graph takes, and where the first trial finds no
  /// photo with the detections asked for (as in Table 1: with the fewest), since others then find none as good as
  /// never.
  BuildingScene(std::uint64_t study_seed, const Cell& cell);

  std::uint64_t seed;
  BuildingCell settings;
  std::shared_ptr<const solvers::MapGraphDatabase> graphs;  ///< null without coarse starts
};

/// Takes the photos of a range of trials, finds their starts and writes the problems. Returns false, and then the
/// scratch memory is of no use, if the monitor asked to stop.
[[nodiscard]] bool simulate_building(const BuildingScene& scene, TrialRange range, const Monitor& monitor,
                                     BuildingScratch& scratch);

}  // namespace ridgeloc::studies
