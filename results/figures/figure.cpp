#include "results/figures/figure.hpp"

#include <fmt/format.h>

#include "results/figures/figure_data.hpp"
#include "results/figures/figure_script.hpp"
#include "results/pictures/picture_file.hpp"

namespace ridgeloc::results {

void draw_figure(const Summary& summary, const FigureSpec& spec, const std::filesystem::path& output,
                 const FigureView& view, std::string_view digest) {
  const FigureData data = figure_data(summary, spec, view);
  PictureCaption caption{spec.title.empty() ? spec.name : spec.title, description_of(data) + ". " + data.footnote};
  if (!digest.empty()) caption.description += fmt::format(". Data: SHA-256 {}", digest);
  write_picture(
      [&](FigureFormat format, const std::filesystem::path& file) { return figure_script(data, format, file); },
      caption, output);
}

}  // namespace ridgeloc::results
