#pragma once

#include <cstddef>

#include "results/schema/schema.hpp"

/// What `building` reports.
namespace ridgeloc::studies::building {

/// Columns of the schema, in its order.
enum Metric : std::size_t {
  ErrorM,
  Convergence,
  ConvergedStarts,
  Iterations,
  Starts,
  ObjectsVisible,
  ObjectsDetected,
  PseudorangeErrorM,
  CoarseErrorM,
  CoarseMeanErrorM,
  CoarseRight
};

/// Its statuses are those of `PhotoStatus`.
const results::Schema& schema();

}  // namespace ridgeloc::studies::building
