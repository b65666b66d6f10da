#include "studies/photos/photo_tables.hpp"

namespace ridgeloc::studies {

using results::DataTable;

DataTable camera_table(const sim::Photo& photo) {
  DataTable table{"camera", {"x_m", "y_m", "z_m", "heading_deg", "image_distance_mm", "visible", "photos_taken"}, {}};
  table.add_row(photo.pose.position_m[0], photo.pose.position_m[1], photo.pose.position_m[2],
                360.0 * photo.pose.heading_turns, photo.image_distance_mm,
                static_cast<std::int64_t>(photo.views.size()), static_cast<std::int64_t>(photo.attempts));
  return table;
}

}  // namespace ridgeloc::studies
