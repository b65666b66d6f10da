#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "results/pictures/page_script.hpp"

namespace ridgeloc::results {

/// A gnuplot script that draws a picture into a file.
using PictureScript = std::function<std::string(FigureFormat format, const std::filesystem::path& output)>;

/// Draws a picture as SVG, PDF or PNG (300 dots per inch), as the extension of `output` says; needs gnuplot. The file
/// appears complete or not at all.
///
/// Throws core::InputError for an unknown extension, an output that cannot be written or a missing gnuplot, and
/// core::IoError when drawing or writing fails.
void write_picture(const PictureScript& script, const std::filesystem::path& output);

}  // namespace ridgeloc::results
