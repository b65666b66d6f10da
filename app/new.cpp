#include <fmt/format.h>

#include <ostream>

#include "app/exit_code.hpp"
#include "app/output.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "results/util/file_system.hpp"
#include "studies/files/study_writer.hpp"
#include "studies/registry.hpp"

namespace ridgeloc::app {

int new_study(const NewOptions& options) {
  const studies::Experiment& experiment = *studies::find_experiment(options.experiment);
  if (!options.output.empty() && results::path_exists(options.output)) {
    throw core::InputError(options.output + ": exists already; choose another -o or remove it");
  }
  write_output(options.output, [&](std::ostream& out) { out << studies::template_toml(experiment); });
  if (!options.output.empty()) fmt::print("{}\n", options.output);
  return Success;
}

}  // namespace ridgeloc::app
