#include "results/figures/figure.hpp"

#include "results/figures/figure_data.hpp"
#include "results/figures/figure_script.hpp"
#include "results/pictures/picture_file.hpp"

namespace ridgeloc::results {

void draw_figure(const Summary& summary, const FigureSpec& spec, const std::filesystem::path& output) {
  const FigureData data = figure_data(summary, spec);
  write_picture(
      [&](FigureFormat format, const std::filesystem::path& file) { return figure_script(data, format, file); },
      output);
}

}  // namespace ridgeloc::results
