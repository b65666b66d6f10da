#include "results/pictures/picture_file.hpp"

#include <fmt/core.h>

#include <system_error>

#include "core/error.hpp"
#include "results/pictures/gnuplot.hpp"
#include "results/util/file_system.hpp"

namespace ridgeloc::results {
namespace {

FigureFormat format_of(const std::filesystem::path& output) {
  const std::string extension = output.extension().string();
  if (extension == ".svg") return FigureFormat::Svg;
  if (extension == ".pdf") return FigureFormat::Pdf;
  if (extension == ".png") return FigureFormat::Png;
  throw core::InputError(fmt::format("'{}': a figure's file name ends in .svg, .pdf or .png", output.string()));
}

}  // namespace

void write_picture(const PictureScript& script, const std::filesystem::path& output) {
  const FigureFormat format = format_of(output);
  refuse_to_replace_result(output);
  require_writable(output);
  TemporaryFile temporary(output);
  run_gnuplot(script(format, temporary.path()));
  std::error_code missing;
  if (std::filesystem::file_size(temporary.path(), missing) == 0 || missing) {
    throw core::IoError(fmt::format("gnuplot wrote nothing for '{}'; is the disk full?", output.string()));
  }
  temporary.publish();
}

}  // namespace ridgeloc::results
