#pragma once

#include <cstddef>

#include "core/matrix.hpp"
#include "solvers/estimators/formula_functions.hpp"
#include "solvers/estimators/k_context.hpp"
#include "solvers/k_formula.hpp"

namespace ridgeloc::solvers {

/// What a formula may use and a context does not have: both in the coordinates of K, as alpha is.
template <class Real, std::size_t P>
struct FormulaInputs {
  core::Vector<Real, P> gradient;  ///< J'We
  core::Vector<Real, P> diagonal;  ///< of J'WJ
};

/// The register of an instruction: P components, or one number in the first place, that stands for all of them.
template <class Real>
struct FormulaOperand {
  const Real* values;
  std::size_t stride;

  [[gnu::always_inline]] const Real& operator[](std::size_t i) const { return values[i * stride]; }
};

/// alpha_i, no shorter than the floor of `squared_alpha`, with its sign.
template <class Real>
[[gnu::always_inline]] inline Real floored_alpha(const Real& alpha) {
  const Real length = core::max(core::abs(alpha), Real(k_length_floor_m));
  return core::select(alpha < Real(0.0), -length, length);
}

/// The value of a formula: K by component, or one k in all of them. Instructions are the same for all lanes, so that
/// choosing between them is an ordinary branch. Registers are loops' memory and not unrolled: a formula is called
/// through a pointer, like other estimators, and its code should be small.
template <class Real, std::size_t P>
[[gnu::noinline]] core::Vector<Real, P> formula_value(const KFormula& formula, const KContext<Real, P>& c,
                                                      const FormulaInputs<Real, P>& inputs) {
  Real registers[KFormula::most_instructions * P];
  const auto operand = [&](std::size_t i) __attribute__((always_inline)) {
    return FormulaOperand<Real>{registers + i * P, formula.instructions[i].by_component ? std::size_t{1} : 0};
  };
  const auto vector = [&](std::size_t i) __attribute__((always_inline)) {
    return core::make_vector<P>(
        [](auto k, const Real* from) __attribute__((always_inline)) { return from[k]; }, registers + i * P);
  };
  for (std::size_t i = 0; i < formula.size; ++i) {
    const KInstruction& instruction = formula.instructions[i];
    Real* const out = registers + i * P;
    const auto store = [out](const core::Vector<Real, P>& values) __attribute__((always_inline)) {
      for (std::size_t k = 0; k < P; ++k) out[k] = values[k];
    };
    const std::size_t width = instruction.by_component ? P : 1;
    const auto of_one = [&](auto f) __attribute__((always_inline)) {
      const auto a = operand(instruction.a);
      for (std::size_t k = 0; k < width; ++k) out[k] = f(a[k]);
    };
    const auto of_two = [&](auto f) __attribute__((always_inline)) {
      const auto a = operand(instruction.a);
      const auto b = operand(instruction.b);
      for (std::size_t k = 0; k < width; ++k) out[k] = f(a[k], b[k]);
    };
    // Of all components, from the first to the last.
    const auto over_all = [&](auto f) __attribute__((always_inline)) {
      const Real* const a = registers + instruction.a * P;
      Real all = a[0];
      for (std::size_t k = 1; k < P; ++k) all = f(all, a[k]);
      *out = all;
    };
    switch (instruction.operation) {
      case KOperation::Constant:
        *out = Real(formula.constants[instruction.a]);
        break;
      case KOperation::Sigma2:
        *out = c.sigma2;
        break;
      case KOperation::Observations:
        *out = Real(static_cast<double>(c.observations));
        break;
      case KOperation::Unknowns:
        *out = Real(static_cast<double>(P));
        break;
      case KOperation::Iteration:
        *out = c.iteration;
        break;
      case KOperation::Trace:
        *out = sum(core::diagonal(c.least_squares.matrix));
        break;
      case KOperation::Squares:
        *out = c.squares;
        break;
      case KOperation::Alpha:
        for (std::size_t k = 0; k < P; ++k) out[k] = floored_alpha(c.alpha[k]);
        break;
      case KOperation::Gradient:
        store(inputs.gradient);
        break;
      case KOperation::Diagonal:
        store(inputs.diagonal);
        break;
      case KOperation::Eigenvalues:
        store(c.eigenvalues);
        break;
      case KOperation::Negate:
        of_one([](const Real& x) { return -x; });
        break;
      case KOperation::Abs:
        of_one([](const Real& x) { return core::abs(x); });
        break;
      case KOperation::Sqrt:
        of_one([](const Real& x) { return formula_sqrt(x); });
        break;
      case KOperation::Log:
        of_one([](const Real& x) { return formula_log(x); });
        break;
      case KOperation::Exp:
        of_one([](const Real& x) { return formula_exp(x); });
        break;
      case KOperation::WholePower: {
        const unsigned exponent = instruction.b;
        of_one([exponent](const Real& x) { return formula_whole_power(x, exponent); });
        break;
      }
      case KOperation::Add:
        of_two([](const Real& x, const Real& y) { return x + y; });
        break;
      case KOperation::Subtract:
        of_two([](const Real& x, const Real& y) { return x - y; });
        break;
      case KOperation::Multiply:
        of_two([](const Real& x, const Real& y) { return x * y; });
        break;
      case KOperation::Divide:
        of_two([](const Real& x, const Real& y) { return x / y; });
        break;
      case KOperation::Power:
        of_two([](const Real& x, const Real& y) { return formula_power(x, y); });
        break;
      case KOperation::Min:
        of_two([](const Real& x, const Real& y) { return formula_min(x, y); });
        break;
      case KOperation::Max:
        of_two([](const Real& x, const Real& y) { return formula_max(x, y); });
        break;
      case KOperation::Sum:
        over_all([](const Real& x, const Real& y) { return x + y; });
        break;
      case KOperation::Mean:
        over_all([](const Real& x, const Real& y) { return x + y; });
        *out = *out * Real(1.0 / static_cast<double>(P));
        break;
      case KOperation::GeometricMean:
        *out = formula_geometric_mean(vector(instruction.a));
        break;
      case KOperation::Median:
        *out = formula_median(vector(instruction.a));
        break;
      case KOperation::Smallest:
        over_all([](const Real& x, const Real& y) { return formula_min(x, y); });
        break;
      case KOperation::Largest:
        over_all([](const Real& x, const Real& y) { return formula_max(x, y); });
        break;
    }
  }
  const auto k = operand(formula.result);
  return core::make_vector<P>([&](auto i) { return k[i]; });
}

}  // namespace ridgeloc::solvers
