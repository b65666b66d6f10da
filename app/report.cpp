#include "results/report/report.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <ostream>
#include <vector>

#include "app/exit_code.hpp"
#include "app/output.hpp"
#include "app/result_probe.hpp"
#include "app/verbs.hpp"
#include "results/summary/completeness.hpp"

namespace ridgeloc::app {

int report(const ReportOptions& options) {
  std::vector<results::ReportSource> sources;
  for (const std::string& path : options.results) {
    sources.push_back(read_probed(path, [&] { return results::read_report_source(path); }));
    const results::Summary& summary = sources.back().summary;
    if (!summary.is_sealed) say(fmt::format("{}: {}\n", path, results::completeness_text(summary)));
  }
  const std::string stem =
      sources.size() == 1 ? std::filesystem::path(options.results.front()).stem().string() : "report";
  const std::string output = options.output.empty() ? stem + ".html" : options.output;
  const std::string page = results::report_html(sources);
  write_output(output, [&](std::ostream& out) { out << page; });
  fmt::print("{}\n", output);
  return Success;
}

}  // namespace ridgeloc::app
