#include "app/recomputation.hpp"

#include <fmt/format.h>

#include <utility>

#include "app/continuation.hpp"
#include "app/result_probe.hpp"
#include "core/error.hpp"
#include "core/isa.hpp"
#include "results/store/result_file.hpp"
#include "studies/registry.hpp"

namespace ridgeloc::app {

Recomputation recomputation_of(const std::string& result) {
  results::Header header = read_probed(result, [&] { return results::read_result_header(result); });
  if (header.isa == results::mixed_isa) {
    throw core::InputError(fmt::format(
        "{}: was merged from results of several instruction sets, so that its trials cannot be computed again",
        result));
  }
  const auto isa = core::find_isa(header.isa);
  if (!isa || !core::is_supported(*isa)) {
    throw core::InputError(fmt::format(
        "{}: was computed with the instruction set {}, which this processor or build lacks", result, header.isa));
  }
  const std::string other_version = fmt::format(
      "{}: was computed by another version of the experiment {}; run the study again", result, header.experiment);
  // Before its study, which this version may read otherwise.
  const studies::Experiment* experiment = studies::find_experiment(header.experiment);
  if (experiment != nullptr && experiment->version() != header.experiment_version) {
    throw core::InputError(other_version);
  }
  studies::Study study = study_of(header, result);
  studies::Plan plan = studies::make_plan(study, *isa);
  if (plan.header.study_hash != header.study_hash) {
    throw core::InputError(other_version);
  }
  return {std::move(header), std::move(study), std::move(plan)};
}

}  // namespace ridgeloc::app
