#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <system_error>

#include "app/exit_code.hpp"
#include "app/look.hpp"
#include "app/output.hpp"
#include "app/result_probe.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "results/figures/figure.hpp"
#include "results/figures/figure_request.hpp"
#include "results/store/result_file.hpp"
#include "results/store/snapshot.hpp"
#include "results/util/file_system.hpp"
#include "results/util/json.hpp"

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

/// Where each figure goes, in each format.
struct Output {
  results::FigureSpec figure;
  fs::path file;
};

/// Names of figures come from the result, and a result from anywhere.
void check_file_name(const std::string& result, const std::string& figure) {
  if (results::is_plain_file_name(figure)) return;
  throw core::InputError(
      fmt::format("{}: a figure is called {}, which can be no file of the output folder; draw it alone, with -o FILE",
                  result, results::json_string(figure)));
}

std::vector<Output> outputs(const std::vector<results::FigureSpec>& figures, const PlotOptions& options) {
  const fs::path output(options.output);
  std::error_code unknown;
  std::vector<std::string> formats = options.formats;
  if (output.has_extension() && !fs::is_directory(output, unknown)) {
    const std::string ending = output.extension().string().substr(1);
    const bool agrees = formats.empty() || formats == std::vector<std::string>{ending};
    if (figures.size() > 1 || !agrees) {
      throw core::InputError(fmt::format(
          "-o {}: names one file, but there are {} figures or another --format; name a folder, or one figure with "
          "--figure",
          options.output, figures.size()));
    }
    return {{figures.front(), output}};
  }
  for (const results::FigureSpec& figure : figures) check_file_name(options.result, figure.name);
  require_folder(output);
  if (formats.empty()) formats = {"svg"};
  std::vector<Output> all;
  for (const results::FigureSpec& figure : figures)
    for (const std::string& format : formats) all.push_back({figure, output / (figure.name + "." + format)});
  return all;
}

}  // namespace

int plot(const PlotOptions& options) {
  const results::Summary summary = results::summarize(look(options.result));
  const std::string digest =
      summary.is_sealed ? read_probed(options.result, [&] { return results::data_digest(options.result); }) : "";
  for (Output& output : outputs(chosen_figures(summary.header, options), options)) {
    if (options.no_bounds) output.figure.bounds = false;
    results::draw_figure(summary, output.figure, output.file, options.view, digest);
    fmt::print("{}\n", output.file.string());
  }
  return Success;
}

}  // namespace ridgeloc::app
