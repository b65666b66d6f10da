#pragma once

#include <optional>
#include <string>

#include "studies/ranging/ranging_settings.hpp"

namespace ridgeloc::studies {

/// Refuses a scene of given objects that cannot be: throws core::InputError that says which and why. Precondition: the
/// cell has given objects.
void check_given_objects(const RangingCell& cell);

/// Whether the camera is at one of some given places, and not anywhere in a box.
bool has_few_camera_places(const RangingCell& cell);

/// What ranges to the objects leave open wherever the camera is: the side of a plane or line that all of them lie on,
/// to a millionth of their extent. None if they determine a position.
std::optional<std::string> ambiguity_of_given_objects(const RangingCell& cell);

}  // namespace ridgeloc::studies
