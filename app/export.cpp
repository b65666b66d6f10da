#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <functional>
#include <ostream>

#include "app/exit_code.hpp"
#include "app/look.hpp"
#include "app/output.hpp"
#include "app/result_probe.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "results/store/result_file.hpp"
#include "results/summary/cell_comparison.hpp"
#include "results/tables/csv.hpp"
#include "results/tables/latex.hpp"
#include "results/tables/summary_json.hpp"
#include "results/util/shell.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::app {

namespace {

/// The metrics and events asked for, or those that the result leads with.
std::vector<std::string> chosen_quantities(const results::Header& header, const ExportOptions& options) {
  if (options.metrics.empty()) return results::leading_quantities(header);
  std::vector<std::string> names;
  for (const auto& metric : header.schema.metrics) names.push_back(metric.name);
  for (const auto& event : header.schema.events) names.push_back(event.name);
  for (const std::string& name : options.metrics) {
    if (std::ranges::find(names, name) != names.end()) continue;
    const std::string nearest = studies::nearest_name(name, names);
    throw core::InputError(fmt::format("{}: no metric or event \"{}\"{} (allowed: {})", options.result, name,
                                       nearest.empty() ? "" : fmt::format(", did you mean \"{}\"?", nearest),
                                       fmt::join(names, ", ")));
  }
  return options.metrics;
}

/// That of a sealed result. Throws core::InputError unless every value, those of single trials too, is as it was
/// written.
std::string checked_digest(const std::string& result) {
  return read_probed(result, [&] { return results::data_digest(result); });
}

/// Writes CSV that begins as the options say.
void write_csv(const ExportOptions& options, const std::function<void(std::ostream&)>& write) {
  write_output(options.output, [&](std::ostream& out) {
    if (options.byte_order_mark) out << "\xEF\xBB\xBF";
    write(out);
  });
}

void export_latex(const ExportOptions& options) {
  const results::Snapshot snapshot = look(options.result);
  const results::Summary summary = results::summarize(snapshot);
  const std::string digest = snapshot.is_sealed ? checked_digest(options.result) : "";
  const auto quantities = chosen_quantities(summary.header, options);
  std::string command = "ridgeloc export " + results::shell_word(options.result) + " --latex";
  for (const std::string& name : options.metrics) command += " --metric " + name;
  const std::string text = results::latex_tables(summary, quantities, {digest, command});
  write_output(options.output, [&](std::ostream& out) { out << text; });
}

void export_cell_comparisons(const ExportOptions& options) {
  const results::Summary summary = results::summarize(look(options.result));
  if (summary.is_sealed) checked_digest(options.result);
  const results::AxisValue base = results::axis_value(summary.header, options.against);
  const auto comparisons = results::compare_cells(summary, base, [&](std::size_t cell, std::size_t method) {
    return summary.is_sealed ? results::read_trials(options.result, cell, method) : results::TrialTable();
  });
  write_csv(options, [&](std::ostream& out) {
    results::write_cell_comparisons_csv(summary.header, comparisons, out, options.decimal_mark);
  });
}

void export_trials(const ExportOptions& options) {
  const results::Snapshot snapshot = look(options.result);
  const results::Header& header = snapshot.header;
  if (!snapshot.is_sealed) {
    throw core::InputError(fmt::format(
        "{}: its run has not come to its end, and single trials are there to read when it has; export without --trials",
        options.result));
  }
  checked_digest(options.result);
  if (header.kept_trials == 0) {
    throw core::InputError(options.result +
                           ": keeps no values of single trials; run the study with [store] trial_columns_mib above 0");
  }
  write_csv(options, [&](std::ostream& out) {
    results::write_trials_csv_heading(header, out, options.decimal_mark);
    for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
      for (std::size_t method = 0; method < header.methods.size(); ++method) {
        results::write_trials_csv(header, cell, method, results::read_trials(options.result, cell, method), out,
                                  options.decimal_mark);
      }
    }
  });
}

}  // namespace

int export_result(const ExportOptions& options) {
  if (int{options.failures} + int{options.trials} + int{options.study} > 1) {
    throw core::InputError("--trials, --failures and --study are three things; ask for one at a time");
  }
  if (options.study) {
    const results::Header header = look(options.result).header;
    write_output(options.output, [&](std::ostream& out) { out << header.study_toml; });
    return Success;
  }
  if (options.failures) {
    const results::Snapshot snapshot = look(options.result);
    write_csv(options, [&](std::ostream& out) {
      results::write_failures_csv(snapshot.header, snapshot.failures, out, options.decimal_mark);
    });
    return Success;
  }
  if (options.latex) {
    export_latex(options);
    return Success;
  }
  if (!options.against.empty()) {
    export_cell_comparisons(options);
    return Success;
  }
  if (options.trials) {
    export_trials(options);
    return Success;
  }
  const results::Summary summary = results::summarize(look(options.result));
  if (options.json) {
    write_output(options.output, [&](std::ostream& out) { results::write_summary_json(summary, out); });
  } else {
    write_csv(options, [&](std::ostream& out) { results::write_summary_csv(summary, out, options.decimal_mark); });
  }
  return Success;
}

}  // namespace ridgeloc::app
