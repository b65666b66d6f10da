#include <ostream>
#include <utility>

#include "app/exit_code.hpp"
#include "app/output.hpp"
#include "app/result_probe.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "results/csv.hpp"
#include "results/result_file.hpp"

namespace ridgeloc::app {

int export_result(const ExportOptions& options) {
  if (int{options.failures} + int{options.trials} + int{options.study} > 1) {
    throw core::InputError("--trials, --failures and --study are three things; ask for one at a time");
  }
  if (options.study) {
    const results::Header header =
        read_probed(options.result, [&] { return results::read_result_header(options.result); });
    write_output(options.output, [&](std::ostream& out) { out << header.study_toml; });
    return Success;
  }
  if (options.failures) {
    const auto [header, failures] = read_probed(options.result, [&] {
      return std::pair(results::read_result_header(options.result), results::read_result_failures(options.result));
    });
    write_output(options.output, [&](std::ostream& out) { results::write_failures_csv(header, failures, out); });
    return Success;
  }
  if (!options.trials) {
    const results::Summary summary = read_probed(options.result, [&] { return results::read_result(options.result); });
    write_output(options.output, [&](std::ostream& out) { results::write_summary_csv(summary, out); });
    return Success;
  }
  const results::Header header = read_probed(options.result, [&] {
    results::data_digest(options.result);  // throws unless every value is as it was written
    return results::read_result_header(options.result);
  });
  write_output(options.output, [&](std::ostream& out) {
    results::write_trials_csv_heading(header, out);
    for (std::size_t cell = 0; cell < header.cells.size(); ++cell) {
      for (std::size_t method = 0; method < header.methods.size(); ++method) {
        results::write_trials_csv(header, cell, method, results::read_trials(options.result, cell, method), out);
      }
    }
  });
  return Success;
}

}  // namespace ridgeloc::app
