#pragma once

#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// A figure that says no more than what it shows, completed. Where `x` of a curve is empty it becomes the first axis
/// with several values that is neither grouped nor a panel. Where `group` is empty it becomes the axes that tell apart
/// cells which would otherwise fall on one point; several methods become lines anyway (`figure_data`). The name is made
/// of y and the kind where it is empty.
///
/// Throws core::InputError for a name that does not exist and for a study that sweeps nothing.
FigureSpec completed_figure(const Header& header, FigureSpec spec);

}  // namespace ridgeloc::results
