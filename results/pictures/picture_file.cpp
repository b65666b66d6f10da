#include "results/pictures/picture_file.hpp"

#include <fmt/core.h>

#include <fstream>
#include <iterator>
#include <string_view>
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

std::string xml_text(std::string_view text) {
  std::string xml;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&') {
      xml += "&amp;";
    } else if (c == '<') {
      xml += "&lt;";
    } else if (c == '>') {
      xml += "&gt;";
    } else {
      xml += byte < 0x20U || byte == 0x7fU ? ' ' : c;
    }
  }
  return xml;
}

void replace_element(std::string& svg, std::string_view name, std::string_view text) {
  const std::string open = fmt::format("<{}>", name);
  const std::size_t begin = svg.find(open);
  const std::size_t end = svg.find(fmt::format("</{}>", name));
  if (begin == std::string::npos || end == std::string::npos) return;
  svg.replace(begin + open.size(), end - begin - open.size(), xml_text(text));
}

void caption_file(const std::filesystem::path& file, const PictureCaption& caption) {
  std::ifstream in(file, std::ios::binary);
  const std::string svg = captioned_svg({std::istreambuf_iterator<char>(in), {}}, caption);
  std::ofstream out(file, std::ios::binary);
  out << svg;
  out.close();
  if (!out) throw core::IoError(fmt::format("'{}': writing failed; is the disk full?", file.string()));
}

}  // namespace

std::string captioned_svg(std::string svg, const PictureCaption& caption) {
  replace_element(svg, "title", caption.title);
  replace_element(svg, "desc", caption.description);
  return svg;
}

void write_picture(const PictureScript& script, const PictureCaption& caption, const std::filesystem::path& output) {
  const FigureFormat format = format_of(output);
  refuse_to_replace_result(output);
  require_writable(output);
  TemporaryFile temporary(output);
  run_gnuplot(script(format, temporary.path()));
  std::error_code missing;
  if (std::filesystem::file_size(temporary.path(), missing) == 0 || missing) {
    throw core::IoError(fmt::format("gnuplot wrote nothing for '{}'; is the disk full?", output.string()));
  }
  if (format == FigureFormat::Svg) caption_file(temporary.path(), caption);
  temporary.publish();
}

}  // namespace ridgeloc::results
