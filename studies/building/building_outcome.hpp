#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "sim/building_map.hpp"
#include "solvers/options.hpp"
#include "studies/study/experiment.hpp"

namespace ridgeloc::studies {

struct BuildingScratch;

/// How a method ended on a photo, in the order of the schema's statuses, and their names.
enum class PhotoStatus : std::uint8_t { Success, OutsideMap, Diverged, NoStart, NoPhoto };
inline constexpr std::array<std::string_view, 5> photo_status_names = {"success", "outside_map", "diverged", "no_start",
                                                                       "no_photo"};

/// What a method makes of one photo. Its position is the mean over the starts that converge inside the map.
struct PhotoOutcome {
  PhotoStatus status = PhotoStatus::NoStart;
  std::size_t starts = 0;
  std::size_t converged = 0;
  std::size_t inside = 0;  ///< converged inside the map
  double x_m = 0.0;
  double y_m = 0.0;
  double error_m = 0.0;     ///< 2-D
  double iterations = 0.0;  ///< mean over those starts
};

/// Solves the problems in the scratch memory from every start and writes the outcomes of the photos. Oracles of K take
/// options.sigma_prior_m for the error of a range. Returns false if the monitor asked to stop.
[[nodiscard]] bool locate(const sim::BuildingMap& map, const Method& method, const solvers::SolverOptions& options,
                          const Monitor& monitor, BuildingScratch& scratch);

}  // namespace ridgeloc::studies
