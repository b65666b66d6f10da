#include "results/table.hpp"

#include <fmt/format.h>

#include "app/exit_code.hpp"
#include "app/verbs.hpp"
#include "results/result_file.hpp"

namespace ridgeloc::app {

int summary(const SummaryOptions& options) {
  for (const std::string& path : options.results) {
    fmt::print("{}", results::summary_table(results::read_result(path)));
  }
  return Success;
}

}  // namespace ridgeloc::app
