#include "app/options.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <thread>

#include "core/error.hpp"
#include "core/isa.hpp"
#include "results/figures/figure_names.hpp"
#include "results/schema/axis_values.hpp"

namespace ridgeloc::app {

namespace {

constexpr int max_threads = 1024;

/// "A:B", the lower before the upper.
results::AxisRange range_of(const std::string& option, const std::string& text) {
  const std::size_t colon = std::min(text.find(':'), text.size());
  const auto low = results::number_in(text.substr(0, colon));
  const auto high = results::number_in(text.substr(std::min(colon + 1, text.size())));
  if (!low || !high || !std::isfinite(*low) || !std::isfinite(*high) || !(*low < *high))
    throw core::InputError(fmt::format("{} {}: write two numbers, the lower first, as in 0.1:10", option, text));
  return {*low, *high};
}

/// "WxH" in millimetres.
results::Page page_of(const std::string& text) {
  const std::size_t by = std::min(text.find('x'), text.size());
  const auto width = results::number_in(text.substr(0, by));
  const auto height = results::number_in(text.substr(std::min(by + 1, text.size())));
  constexpr double largest_mm = 2000.0;
  const auto fits = [&](const std::optional<double>& length) {
    return length && *length > 0.0 && *length <= largest_mm;
  };
  if (!fits(width) || !fits(height))
    throw core::InputError(
        fmt::format("--size {}: write width and height in mm, as in 180x120, at most {:g} each", text, largest_mm));
  return {*width, *height};
}

/// How figures are looked at, those of the study too.
void add_view_options(CLI::App& verb, results::FigureView& view) {
  const auto limits = [&](const char* option, std::optional<results::AxisRange>& range, const char* description) {
    verb.add_option_function<std::string>(
            option, [option, &range](const std::string& text) { range = range_of(option, text); }, description)
        ->type_name("A:B");
  };
  limits("--xlim", view.x, "ends of the horizontal axis");
  limits("--ylim", view.y, "ends of the vertical axes");
  verb.add_flag("--log-x", view.log_x, "logarithmic horizontal axis (default: where it spans decades)");
  verb.add_option_function<std::string>(
          "--size", [&view](const std::string& text) { view.size = page_of(text); },
          "size of the figure in mm (default: 85 wide for each column of panels, as high as they need)")
      ->type_name("WxH");
  verb.add_option("--columns", view.columns, "columns of panels (default: 1, or one for each quantity)")
      ->check(CLI::Range(1, 20))
      ->type_name("N");
}

/// What describes one figure. All of it needs --y, without which the figures of the study are drawn.
void add_figure_options(CLI::App& verb, results::FigureSpec& figure, CLI::Option* chosen) {
  CLI::Option* y =
      add_names(verb, "--y", figure.y, "draw a figure of this metric or event instead of the study's; may be repeated")
          ->excludes(chosen);
  const auto text = [&](const char* option, std::string& value, const char* description) {
    return verb.add_option(option, value, description)->needs(y);
  };
  text("--kind", figure.kind, "curve over an axis, or the distribution of one metric: ecdf or histogram")
      ->check(CLI::IsMember({"curve", "ecdf", "histogram"}));
  text("--x", figure.x, "horizontal axis (default: the first one swept)")->type_name("AXIS");
  add_names(verb, "--group", figure.group,
            "axis or \"method\", a line for each of its values; may be repeated (default: what tells lines apart)")
      ->needs(y);
  text("--facet", figure.facet, "axis or \"method\", a panel for each of its values")->type_name("NAME");
  text("--statistic", figure.statistic,
       "mean, median, rms, or a quantile: p95 (default: that which the metric leads with)")
      ->check(CLI::IsMember(results::figure_statistics()));
  add_names(verb, "--methods", figure.methods, "method to draw; may be repeated (default: all)")->needs(y);
  verb.add_option_function<std::vector<std::string>>(
          "--where",
          [&figure](const std::vector<std::string>& items) {
            for (const std::string& item : items) results::add_axis_values(figure.where, item);
          },
          "only cells with these values of an axis, for example range_sigma_m=0.1,0.3; may be repeated")
      ->type_name("AXIS=VALUE,...")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false)
      ->needs(y);
  verb.add_flag("--log", figure.log_y, "logarithmic vertical axis")->needs(y);
  text("--title", figure.title, "title of the figure")->type_name("TEXT");
}

/// --set KEY=VALUE.
void add_overrides(CLI::App& verb, std::vector<std::string>& overrides) {
  verb.add_option_function<std::vector<std::string>>(
          "--set",
          [&overrides](const std::vector<std::string>& items) {
            overrides.insert(overrides.end(), items.begin(), items.end());
          },
          "overrides a key of the study, for example scene.depth_m=[2,15] or method.0.k=fixed; may be repeated")
      ->type_name("KEY=VALUE")
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

void add_isa(CLI::App& verb, std::string& isa, const char* description) {
  verb.add_option("--isa", isa, description)
      ->check(CLI::IsMember(std::vector<std::string>(core::isa_names.begin(), core::isa_names.end())));
}

}  // namespace

void add_threads(CLI::App& verb, int& threads) {
  verb.add_option("--threads", threads, "threads to use")
      ->default_val(std::clamp(static_cast<int>(std::thread::hardware_concurrency()), 1, max_threads))
      ->check(CLI::Range(1, max_threads));
}

CLI::Option* add_names(CLI::App& verb, const char* option, std::vector<std::string>& names, const char* description,
                       const char* value_name) {
  return verb.add_option(option, names, description)
      ->type_name(value_name)
      ->expected(1)
      ->take_all()
      ->allow_extra_args(false);
}

void add_study_options(CLI::App& verb, StudyOptions& options) {
  verb.add_option("STUDY", options.studies, "study files, or names from the catalog (ridgeloc list studies)")
      ->required();
  verb.add_option_function<std::string>(
          "--trials", [&options](const std::string& n) { options.overrides.push_back("trials=" + n); },
          "trials per cell (10000, 1e6)")
      ->type_name("N");
  verb.add_option_function<std::string>(
          "--seed", [&options](const std::string& n) { options.overrides.push_back("seed=" + n); },
          "seed of all random numbers")
      ->type_name("N");
  verb.add_option_function<std::string>(
          "--audit", [&options](const std::string& f) { options.overrides.push_back("audit=" + f); },
          "share of the trials that Ceres solves again, 0 to 1; 0 switches the audit off")
      ->type_name("F");
  add_overrides(verb, options.overrides);
  add_threads(verb, options.threads);
  add_isa(verb, options.isa,
          "instruction set to compute with; without it the one that a stopped run has begun with, else the widest that "
          "this processor has");
}

void add_solve_options(CLI::App& verb, SolveOptions& options) {
  verb.add_option("DATA", options.data, "measured ranges: a CSV file, or - for standard input")->required();
  verb.add_option("--objects", options.objects, "where the objects are: a CSV file with their names and coordinates")
      ->type_name("FILE");
  add_names(verb, "--solver", options.solvers, "solver (ridgeloc list solvers); may be repeated (default: lm)");
  verb.add_option("--study", options.study, "the methods of this study instead")->type_name("STUDY");
  add_overrides(verb, options.overrides);
  add_names(verb, "--column", options.columns,
            "what a column is called: epoch, object, range, score, x, y or z; may be repeated", "ROLE=NAME");
  const std::vector<std::string> units = {"m", "cm", "mm", "km", "ft"};
  verb.add_option("--unit", options.range_unit, "unit of the ranges")
      ->default_val(options.range_unit)
      ->check(CLI::IsMember(units));
  verb.add_option("--position-unit", options.position_unit, "unit of the positions of objects")
      ->default_val(options.position_unit)
      ->check(CLI::IsMember(units));
  verb.add_option_function<std::vector<double>>(
          "--start",
          [&options](const std::vector<double>& at) {
            options.start = {at[0], at[1], at[2]};
          },
          "where solvers start (m), which decides between mirror images; the height where it is known (default: found "
          "for "
          "each epoch)")
      ->check(CLI::Range(-1e9, 1e9))
      ->delimiter(',')
      ->expected(3)
      ->type_name("X,Y,Z");
  verb.add_option("--sigma", options.sigma_m, "standard deviation of a range (m) (default: from the residuals)")
      ->check(CLI::Range(1e-9, 1e6))
      ->type_name("M");
  verb.add_flag("--strict", options.is_strict,
                "refuse data with readings that cannot be used, instead of leaving them out");
  verb.add_flag("--json", options.json, "a JSON object a line instead of CSV");
  verb.add_option("-o", options.output, "file to write (default: standard output)")->type_name("FILE");
  verb.add_option("--as-noise", options.noise, "write the errors as samples of noise for studies")->type_name("FILE");
  verb.add_option("--as-scene", options.scene, "write a study with these objects and positions")->type_name("FILE");
  add_isa(verb, options.isa, "instruction set to compute with (default: the widest that this processor has)");
}

void add_summary_options(CLI::App& verb, SummaryOptions& options) {
  verb.add_option("RESULT", options.results, "result files")->required();
  CLI::Option* all = verb.add_flag("--all", options.all, "every number of every cell and method");
  add_names(verb, "--metric", options.metrics,
            "metric or outcome to show; may be repeated (default: what figures show and methods are compared by)")
      ->excludes(all);
  verb.add_option("--cell", options.cell,
                  "cells with these values of the sweep, or the number of a cell (default: all)")
      ->type_name("AXIS=VALUE,...");
  add_names(verb, "--method", options.methods, "method, or difference of two, to show; may be repeated (default: all)");
}

void add_export_options(CLI::App& verb, ExportOptions& options) {
  verb.add_option("RESULT", options.result, "result file")->required();
  CLI::Option* csv = verb.add_flag("--csv", options.csv, "comma-separated values (the default)");
  CLI::Option* trials = verb.add_flag("--trials", options.trials, "a row per kept trial instead");
  CLI::Option* failures =
      verb.add_flag("--failures", options.failures, "a row per failed trial that is listed instead");
  CLI::Option* study =
      verb.add_flag("--study", options.study, "the complete study instead, as a file to run")->excludes(csv);
  CLI::Option* json = verb.add_flag("--json", options.json, "the same as JSON")
                          ->excludes(csv)
                          ->excludes(trials)
                          ->excludes(failures)
                          ->excludes(study);
  CLI::Option* latex = verb.add_flag("--latex", options.latex, "tables for LaTeX (booktabs): cells by methods")
                           ->excludes(csv)
                           ->excludes(trials)
                           ->excludes(failures)
                           ->excludes(json)
                           ->excludes(study);
  add_names(verb, "--metric", options.metrics,
            "metric or event of a LaTeX table; may be repeated (default: those of the study's figures)")
      ->needs(latex);
  verb.add_option("--against", options.against,
                  "differences and ratios of each cell to the one with this value of an axis, a row per method and "
                  "metric, for example points=3")
      ->type_name("AXIS=VALUE")
      ->excludes(trials)
      ->excludes(failures)
      ->excludes(study)
      ->excludes(json)
      ->excludes(latex);
  const auto of_csv = [&](CLI::Option* option) { option->excludes(json)->excludes(latex)->excludes(study); };
  of_csv(verb.add_flag("--bom", options.byte_order_mark, "begin the CSV with a mark by which spreadsheets know UTF-8"));
  of_csv(verb.add_flag_callback(
      "--decimal-comma", [&options] { options.decimal_mark = results::DecimalMark::Comma; },
      "CSV with 0,5 for numbers and semicolons between them, as spreadsheets of many countries read it"));
  verb.add_option("-o", options.output, "file to write")->type_name("FILE");
}

void add_plot_options(CLI::App& verb, PlotOptions& options) {
  verb.add_option("RESULT", options.result, "result file")->required();
  verb.add_option("-o", options.output, "folder, or a file for one figure")->type_name("PATH");
  CLI::Option* chosen =
      add_names(verb, "--figure", options.figures, "name of a figure of the study; may be repeated (default: all)");
  add_names(verb, "--format", options.formats, "svg, pdf or png; may be repeated (default: svg)", "FORMAT")
      ->check(CLI::IsMember({"svg", "pdf", "png"}));
  verb.add_flag("--no-bounds", options.no_bounds, "leave out the bounds of metrics (the Cramer-Rao bound of errors)");
  add_figure_options(verb, options.asked, chosen);
  add_view_options(verb, options.view);
}

}  // namespace ridgeloc::app
