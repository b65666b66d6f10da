#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ridgeloc::solvers {

/// What one instruction of a formula of K computes.
enum class KOperation : std::uint8_t {
  // Leaves: a constant, and the quantities that `formula_quantities` names, in its order.
  Constant,
  Sigma2,
  Observations,
  Unknowns,
  Iteration,
  Trace,
  Squares,
  Alpha,
  Gradient,
  Diagonal,
  Eigenvalues,
  // Of one value, component by component.
  Negate,
  Abs,
  Sqrt,
  Log,
  Exp,
  WholePower,
  // Of two values, component by component.
  Add,
  Subtract,
  Multiply,
  Divide,
  Power,
  Min,
  Max,
  // One number of all components.
  Sum,
  Mean,
  GeometricMean,
  Median,
  Smallest,
  Largest,
};

/// `a` and `b` are numbers of earlier instructions; of Constant, `a` is the number of the constant, and of WholePower,
/// `b` the exponent.
struct KInstruction {
  KOperation operation = KOperation::Constant;
  std::uint8_t a = 0;
  std::uint8_t b = 0;
  bool by_component = false;  ///< whether the result has p components instead of one
};

/// A formula of the ridge parameter, compiled: plain data that kernels run over any `Real`. Each instruction writes a
/// register of its own. Made by `compile_k`; by default the formula "0".
struct KFormula {
  static constexpr std::size_t most_characters = 500;
  static constexpr std::size_t most_instructions = 64;
  static constexpr std::size_t most_constants = 16;

  std::array<KInstruction, most_instructions> instructions{};
  std::array<double, most_constants> constants{};
  std::uint8_t size = 1;    ///< instructions that there are
  std::uint8_t result = 0;  ///< the one whose value is K
  bool needs_ols_step = false;
  bool needs_squares = false;
  bool needs_eigenvalues = false;
};

}  // namespace ridgeloc::solvers
