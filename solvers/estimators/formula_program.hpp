#pragma once
// Internal to solvers: the instructions of a formula of K, as they are put together.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "solvers/estimators/formula_names.hpp"
#include "solvers/estimators/formula_text.hpp"
#include "solvers/k_formula.hpp"

namespace ridgeloc::solvers {

/// A number that is known now, or the value of an instruction.
struct FormulaTerm {
  std::optional<double> number;
  std::uint8_t instruction = 0;
  bool by_component = false;
};

/// Collects instructions: what is known now is computed now, and what is there already is used again. `at` is where in
/// the text an operation stands, for the message of one that cannot be. The text must outlive it.
class FormulaProgram {
 public:
  explicit FormulaProgram(const FormulaText& text) : text_(text) { formula_.size = 0; }

  FormulaTerm quantity(std::size_t index, std::size_t at);
  FormulaTerm call(const FormulaFunction& function, const std::vector<FormulaTerm>& arguments, std::size_t at);
  FormulaTerm of_one(KOperation operation, const FormulaTerm& a, std::size_t at);
  FormulaTerm of_two(KOperation operation, const FormulaTerm& a, const FormulaTerm& b, std::size_t at);
  /// Whole powers up to 64 and square roots are exact to rounding and fast; others are e^(y log x).
  FormulaTerm power(const FormulaTerm& base, const FormulaTerm& exponent, std::size_t at);

  KFormula finish(const FormulaTerm& result);

 private:
  FormulaTerm whole_power(const FormulaTerm& base, std::uint8_t exponent, std::size_t at);
  FormulaTerm folded(KOperation operation, double a, double b, std::size_t at) const;
  FormulaTerm finite(double value, std::size_t at) const;
  void note_need(KOperation operation);
  std::uint8_t instruction_of(const FormulaTerm& term, std::size_t at);
  FormulaTerm emit(const KInstruction& instruction, std::size_t at);
  FormulaError too_long(std::size_t at, std::size_t most, const char* of) const;

  const FormulaText& text_;
  KFormula formula_;
  std::uint8_t constants_ = 0;
};

}  // namespace ridgeloc::solvers
