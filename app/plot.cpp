#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "app/exit_code.hpp"
#include "app/look.hpp"
#include "app/output.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "results/figures/figure.hpp"
#include "results/figures/figure_request.hpp"
#include "results/store/snapshot.hpp"

namespace ridgeloc::app {

namespace {

namespace fs = std::filesystem;

std::vector<results::FigureSpec> chosen_figures(const results::Header& header, const PlotOptions& options) {
  if (!options.asked.y.empty()) return {results::completed_figure(header, options.asked)};
  if (header.figures.empty()) {
    throw core::InputError(options.result + ": its study has no [[figure]]; name what to draw with --y, for example " +
                           header.schema.metrics.front().name);
  }
  if (options.figures.empty()) return header.figures;
  std::vector<results::FigureSpec> chosen;
  std::vector<std::string> names;
  for (const auto& figure : header.figures) names.push_back(figure.name);
  for (const std::string& name : options.figures) {
    const auto found = std::ranges::find(header.figures, name, &results::FigureSpec::name);
    if (found == header.figures.end()) {
      throw core::InputError(
          fmt::format("{}: no figure \"{}\" (allowed: {})", options.result, name, fmt::join(names, ", ")));
    }
    chosen.push_back(*found);
  }
  return chosen;
}

}  // namespace

int plot(const PlotOptions& options) {
  const results::Summary summary = results::summarize(look(options.result));
  auto figures = chosen_figures(summary.header, options);
  const fs::path output(options.output);
  std::error_code unknown;
  const bool one_file = output.has_extension() && !fs::is_directory(output, unknown);
  if (one_file && (figures.size() > 1 || !options.formats.empty())) {
    throw core::InputError(fmt::format(
        "-o {}: names one file, but there are {} figures or a --format; name a folder, or one figure with --figure",
        options.output, figures.size()));
  }
  if (!one_file) require_folder(output);
  std::vector<std::string> formats = options.formats;
  if (formats.empty()) formats = {"svg"};
  for (results::FigureSpec& figure : figures) {
    if (options.no_bounds) figure.bounds = false;
    for (const std::string& format : formats) {
      const fs::path path = one_file ? output : output / (figure.name + "." + format);
      results::draw_figure(summary, figure, path);
      fmt::print("{}\n", path.string());
    }
  }
  return Success;
}

}  // namespace ridgeloc::app
