#pragma once

#include <string>
#include <vector>

#include "app/verbs.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

/// Options that several verbs share, and those of verbs that have many.
namespace ridgeloc::app {

void add_threads(CLI::App& verb, int& threads);

/// An option that may be repeated and takes one value each time.
CLI::Option* add_names(CLI::App& verb, const char* option, std::vector<std::string>& names, const char* description,
                       const char* value_name = "NAME");

void add_study_options(CLI::App& verb, StudyOptions& options);

void add_summary_options(CLI::App& verb, SummaryOptions& options);

void add_solve_options(CLI::App& verb, SolveOptions& options);

void add_export_options(CLI::App& verb, ExportOptions& options);

void add_plot_options(CLI::App& verb, PlotOptions& options);

}  // namespace ridgeloc::app
