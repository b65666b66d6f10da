#include "results/tables/table.hpp"

#include <fmt/format.h>

#include "app/exit_code.hpp"
#include "app/result_probe.hpp"
#include "app/verbs.hpp"
#include "results/store/result_file.hpp"

namespace ridgeloc::app {

int summary(const SummaryOptions& options) {
  for (const std::string& path : options.results) {
    const results::Summary summary = read_probed(path, [&] { return results::read_result(path); });
    fmt::print("{}", results::summary_table(summary));
  }
  return Success;
}

}  // namespace ridgeloc::app
