#pragma once

#include <filesystem>
#include <string>

#include "results/figures/figure_data.hpp"
#include "results/pictures/page_script.hpp"

namespace ridgeloc::results {

/// The gnuplot script that draws a figure into `output`, 85 mm wide: title, legend, one panel above the other
/// over a shared x axis, footnote. Lines differ by colour (Okabe and Ito's palette), mark and dash; with
/// several metrics the mark and colour tell the group, the dash and open or filled marks tell the metric.
/// Points of different lines stand slightly beside each other. Infinite values are left out and counted in
/// the footnote.
std::string figure_script(const FigureData& data, FigureFormat format, const std::filesystem::path& output);

}  // namespace ridgeloc::results
