#pragma once

#include <cstddef>
#include <string>

#include "studies/measured/epoch.hpp"

namespace ridgeloc::studies {

/// What the objects of an epoch allow, whatever the ranges to them are.
struct EpochGeometry {
  std::size_t distinct = 0;  ///< positions that objects are at
  bool is_solvable = false;  ///< as many as there are unknowns
  Place start{};             ///< beside their mean, as far as the mean range, off the plane that they nearly lie in
  std::string note;          ///< what a user must know, the words below, separated by blanks; may be empty
};

/// Words of a note: objects that share a position; objects in one plane (on one line, where the height is known), so
/// that a mirror image of the answer has the same ranges and the start decides; objects on one line (in one point), so
/// that ranges leave open where around it the answer is.
inline constexpr const char* note_of_duplicates = "duplicates";
inline constexpr const char* note_of_mirror = "mirror";
inline constexpr const char* note_of_line = "around";

EpochGeometry geometry_of_epoch(const Epoch& epoch, bool knows_height);

}  // namespace ridgeloc::studies
