#pragma once

#include <filesystem>
#include <string>

#include "results/pictures/floor_plan.hpp"
#include "results/pictures/page_script.hpp"

namespace ridgeloc::results {

/// The gnuplot script that draws plans of one floor into `output`, 180 mm wide: title, panels in one scale, legend,
/// footnote. Precondition: there is a panel.
std::string floor_plan_script(const FloorPlan& plan, FigureFormat format, const std::filesystem::path& output);

}  // namespace ridgeloc::results
