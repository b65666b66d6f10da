#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace ridgeloc::core {

/// How one solver ended on one trial. A trial that fails is data: it is counted, never redrawn or dropped.
enum class Status : std::uint8_t {
  Converged,       ///< the last step was shorter than the step tolerance
  IterationLimit,  ///< the iteration limit was reached first
  Singular,        ///< a normal matrix was singular to rounding
  NonFinite,       ///< a step was infinite or not a number
  LeftDomain,      ///< the estimate left the domain of the model
  NotRun = 255,    ///< no solver has written this slot yet: never the outcome of a solver
};

/// Names of the outcomes as they stand in result files and tables, indexed by the value of `Status`.
inline constexpr std::array<std::string_view, 5> status_names = {"converged", "iteration_limit", "singular",
                                                                 "non_finite", "left_domain"};

}  // namespace ridgeloc::core
