#pragma once

#include <filesystem>
#include <functional>
#include <string>

#include "results/pictures/page_script.hpp"

namespace ridgeloc::results {

/// A gnuplot script that draws a picture into a file.
using PictureScript = std::function<std::string(FigureFormat format, const std::filesystem::path& output)>;

/// What a picture says of itself to those who find it alone: the title and the description of an SVG file. Other
/// formats have no place for it.
struct PictureCaption {
  std::string title;
  std::string description;
};

/// Draws a picture as SVG, PDF or PNG (300 dots per inch), as the extension of `output` says; needs gnuplot. The file
/// appears complete or not at all.
///
/// Throws core::InputError for an unknown extension, an output that cannot be written or a missing gnuplot, and
/// core::IoError when drawing or writing fails.
void write_picture(const PictureScript& script, const PictureCaption& caption, const std::filesystem::path& output);

/// gnuplot's SVG with this title and description in place of those that gnuplot gives to every picture.
std::string captioned_svg(std::string svg, const PictureCaption& caption);

}  // namespace ridgeloc::results
