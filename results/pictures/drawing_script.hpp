#pragma once

#include <filesystem>
#include <string>

#include "results/pictures/drawing.hpp"
#include "results/pictures/page_script.hpp"

namespace ridgeloc::results {

/// The gnuplot script that draws a picture of a plane into `output`, 120 mm wide: title, legend, plot with both axes in
/// one scale, footnote.
std::string drawing_script(const Drawing& drawing, FigureFormat format, const std::filesystem::path& output);

}  // namespace ridgeloc::results
