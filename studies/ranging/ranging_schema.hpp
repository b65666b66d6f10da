#pragma once

#include <cstddef>

#include "results/schema/schema.hpp"
#include "studies/solving/audit.hpp"

/// What `ranging` reports.
namespace ridgeloc::studies::ranging {

/// Columns of the schema, in its order.
enum Metric : std::size_t {
  ErrorM,
  ErrorAllM,
  Iterations,
  EtaFirst,
  EtaLast,
  EtaMean,
  ResidualRmsM,
  CrbM,
  Gdop,
  Condition,
  SquaredErrorM2,
  ErrorXM,
  FirstOfAudit,  ///< and the others, in the order of AuditMetric
  Nees = FirstOfAudit + audit_metric_count
};

const results::Schema& schema();

}  // namespace ridgeloc::studies::ranging
