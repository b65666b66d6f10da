#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "solvers/k_formula.hpp"

namespace ridgeloc::solvers {

/// A name that formulas of K may use, as users see it.
struct FormulaName {
  std::string_view name;
  std::string_view summary;
};

/// Quantities of the problem.
std::span<const FormulaName> formula_quantities();

/// Functions; the name shows what they take: "sqrt(x)", "min(x, y, ...)", "sum(v)", v a quantity by component.
std::span<const FormulaName> formula_functions();

/// What is wrong with a formula: the message begins with where, "column 5: ..." (from 1), or "line 2, column 5: ...".
struct FormulaError : core::InputError {
  using core::InputError::InputError;

  std::string unknown;                  ///< a name that there is not, or empty
  std::vector<std::string> candidates;  ///< names that might have been meant
};

/// Compiles a formula of K:
///
///   sum     = product { ("+" | "-") product }
///   product = signed { ("*" | "/") signed }
///   signed  = { "+" | "-" } power
///   power   = value [ "^" signed ]
///   value   = number | quantity | function "(" sum { "," sum } ")" | "(" sum ")"
///
/// Operations that a formula writes twice it computes once, and those of numbers alone now. Throws FormulaError.
KFormula compile_k(std::string_view text);

}  // namespace ridgeloc::solvers
