#pragma once

#include "results/tables/data_table.hpp"
#include "sim/photo.hpp"

namespace ridgeloc::studies {

/// Table "camera" of a replay: where a photo was taken, and what of.
results::DataTable camera_table(const sim::Photo& photo);

}  // namespace ridgeloc::studies
