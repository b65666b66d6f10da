#include "studies/study/replay.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <utility>

#include "app/exit_code.hpp"
#include "app/instruction_set.hpp"
#include "app/name_choice.hpp"
#include "app/recomputation.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "results/schema/text.hpp"
#include "results/util/file_system.hpp"
#include "results/util/json.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/plan/cell_choice.hpp"
#include "studies/registry.hpp"
#include "studies/study/capabilities.hpp"

namespace ridgeloc::app {

namespace {

/// Whether a file is a result, or is called like one.
bool is_result(const std::string& path) {
  return results::begins_as_hdf5(path) || std::filesystem::path(path).extension() == ".h5";
}

/// What the result holds, or what the study would compute on this processor.
Recomputation open_source(const std::string& source) {
  if (is_result(source)) return recomputation_of(source);
  studies::Study study = studies::read_study(studies::find_study(source));
  studies::Plan plan = studies::make_plan(study, instruction_set(""));
  results::Header header = plan.header;
  return {std::move(header), std::move(study), std::move(plan)};
}

/// The methods of the study that are asked for, and the solvers asked for beside them.
std::vector<studies::Method> chosen_methods(const studies::Study& study, const ReplayOptions& options) {
  std::vector<studies::Method> chosen;
  if (options.methods.empty()) chosen = study.methods;
  std::vector<std::string> labels;
  for (const studies::Method& method : study.methods) labels.push_back(method.label);
  const std::vector<std::string> own = studies::label_names(*study.experiment);
  for (const std::string& label : options.methods) {
    // What an experiment reports under its own label belongs to every replay.
    if (std::ranges::find(own, label) != own.end()) continue;
    check_name("--method", label, labels);
    chosen.push_back(*std::ranges::find(study.methods, label, &studies::Method::label));
  }
  const std::vector<std::string> solvers = studies::solvers_of(*study.experiment);
  if (!options.solvers.empty() && solvers.empty())
    studies::refuse_missing(*study.experiment, studies::SolverChoice::what);
  for (const std::string& solver : options.solvers) {
    check_name("--solver", solver, solvers);
    const bool taken = std::ranges::find(chosen, solver, &studies::Method::label) != chosen.end();
    chosen.push_back({taken ? solver + ", settings shared" : solver, solver, {}});
  }
  return chosen;
}

void print_text(const studies::Replay& replay, const std::string& title) {
  fmt::print("{}\n", title);
  for (const results::DataTable& table : replay.scene) fmt::print("\n{}", results::table_text(table));
  for (const studies::ReplayedMethod& method : replay.methods) {
    for (const results::DataTable& table : method.tables) {
      if (table.rows.empty()) continue;
      fmt::print("\n{}, {}", method.label, results::table_text(table));
    }
  }
}

/// Members of a JSON object, one for each table.
std::string members(const std::vector<results::DataTable>& tables, std::size_t indent) {
  std::vector<std::string> list;
  for (const results::DataTable& table : tables) {
    list.push_back(
        fmt::format("{:{}}{}: {}", "", indent, results::json_string(table.name), results::table_json(table, indent)));
  }
  return fmt::format("{}", fmt::join(list, ",\n"));
}

void print_json(const studies::Replay& replay, const Recomputation& source, const studies::Cell& cell,
                std::uint64_t trial) {
  const std::vector<results::Axis>& axes = source.plan.header.axes;
  std::vector<std::string> factors;
  for (std::size_t a = 0; a < axes.size(); ++a) {
    const results::FactorValue& value = axes[a].values[cell.indices[a]];
    const std::string text = results::factor_text(value);
    factors.push_back(fmt::format("{}: {}", results::json_string(axes[a].name),
                                  std::holds_alternative<std::string>(value) ? results::json_string(text) : text));
  }
  std::vector<std::string> methods;
  for (const studies::ReplayedMethod& method : replay.methods) {
    methods.push_back(fmt::format("    {{\n      \"method\": {},\n      \"solver\": {},\n{}\n    }}",
                                  results::json_string(method.label), results::json_string(method.solver),
                                  members(method.tables, 6)));
  }
  fmt::print(
      "{{\n  \"title\": {},\n  \"experiment\": {},\n  \"experiment_version\": {},\n  \"seed\": {},\n"
      "  \"isa\": {},\n  \"cell\": {{{}}},\n  \"trial\": {},\n  \"scene\": {{\n{}\n  }},\n  \"methods\": [\n{}\n  "
      "]\n}}\n",
      results::json_string(source.study.title), results::json_string(source.plan.header.experiment),
      source.plan.header.experiment_version, source.study.seed, results::json_string(source.plan.header.isa),
      fmt::join(factors, ", "), trial, members(replay.scene, 4), fmt::join(methods, ",\n"));
}

}  // namespace

int replay(const ReplayOptions& options) {
  const Recomputation source = open_source(options.source);
  const studies::Experiment& experiment = *source.study.experiment;
  const studies::Cell cell = studies::choose_cell(source.plan, options.cell);
  const auto methods = chosen_methods(source.study, options);
  const auto simulation = experiment.prepare(source.study.seed, cell, methods);
  const auto workspace = experiment.make_workspace(source.plan.isa);
  studies::Replay replay =
      studies::required<studies::TrialReplay>(experiment, *simulation).replay(options.trial, *workspace);

  const std::string factors = results::cell_text(source.plan.header, cell.index);
  const std::string title =
      fmt::format("{}: {}{}trial {}", source.study.title, factors, factors.empty() ? "" : ", ", options.trial);
  if (!options.output.empty()) {
    std::visit(
        [&](auto& drawing) {
          drawing.title = title;
          results::draw(drawing, options.output);
        },
        replay.drawing);
  }
  if (options.json) {
    print_json(replay, source, cell, options.trial);
  } else {
    print_text(replay, title);
  }
  return Success;
}

}  // namespace ridgeloc::app
