#pragma once

#include <algorithm>
#include <cstddef>
#include <string>

#include "results/schema/schema.hpp"
#include "studies/study/experiment.hpp"
#include "studies/study/study.hpp"
#include "tests/support/catch.hpp"

namespace ridgeloc::tests {

/// Where the metric of that name stands among those of the study's experiment.
inline std::size_t metric_of(const studies::Study& study, const std::string& name) {
  const auto& metrics = study.experiment->schema().metrics;
  const auto found = std::ranges::find(metrics, name, &results::MetricInfo::name);
  REQUIRE(found != metrics.end());
  return static_cast<std::size_t>(found - metrics.begin());
}

}  // namespace ridgeloc::tests
