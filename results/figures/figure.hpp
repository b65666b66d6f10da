#pragma once

#include <filesystem>
#include <string_view>

#include "results/figures/figure_view.hpp"
#include "results/summary/summary.hpp"

namespace ridgeloc::results {

/// Draws a figure as SVG, PDF or PNG (300 dots per inch), as the extension of `output` says; needs gnuplot.
/// The file appears complete or not at all. An SVG has the title and the description of the figure in it, with the
/// digest of the data where one is given.
///
/// Throws core::InputError for an unknown extension, an unknown name in the figure (see `figure_data`) or a
/// missing gnuplot, and core::IoError when drawing or writing fails.
void draw_figure(const Summary& summary, const FigureSpec& spec, const std::filesystem::path& output,
                 const FigureView& view = {}, std::string_view digest = {});

}  // namespace ridgeloc::results
