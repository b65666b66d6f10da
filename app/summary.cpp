#include <fmt/format.h>

#include <string>

#include "app/exit_code.hpp"
#include "app/look.hpp"
#include "app/name_choice.hpp"
#include "app/stop_text.hpp"
#include "app/verbs.hpp"
#include "results/store/snapshot.hpp"
#include "results/tables/fitted_table.hpp"
#include "results/tables/overview.hpp"
#include "results/tables/table.hpp"
#include "studies/plan/cell_choice.hpp"

namespace ridgeloc::app {

namespace {

results::SummaryChoice choice_of(const SummaryOptions& options, const results::Header& header) {
  std::vector<std::string> measures;
  for (const results::MetricInfo& metric : header.schema.metrics) measures.push_back(metric.name);
  for (const results::EventInfo& event : header.schema.events) measures.push_back(event.name);
  for (const std::string& name : options.metrics) check_name("--metric", name, measures);

  std::vector<std::string> labels;
  for (const results::MethodInfo& method : header.methods) labels.push_back(method.label);
  for (const std::string& label : options.methods) check_name("--method", label, labels);

  results::SummaryChoice choice = results::whole(header);
  choice.metrics = options.metrics;
  choice.cells = studies::choose_cells(header, options.cell);
  if (!options.methods.empty()) choice.methods = results::methods_labelled(header, options.methods);
  return choice;
}

}  // namespace

int summary(const SummaryOptions& options) {
  bool is_first = true;
  for (const std::string& path : options.results) {
    const results::Summary summary = results::summarize(look(path));
    const results::SummaryChoice choice = choice_of(options, summary.header);
    if (options.all) {
      fmt::print("{}", results::summary_table(summary, choice));
    } else {
      fmt::print("{}{}", is_first ? "" : "\n", results::summary_overview(summary, choice));
    }
    if (const std::string reached = reached_text(summary, path); !reached.empty())
      fmt::print("\n{}", results::wrapped_text(fmt::format("stop: {}", reached), results::summary_width));
    is_first = false;
  }
  return Success;
}

}  // namespace ridgeloc::app
