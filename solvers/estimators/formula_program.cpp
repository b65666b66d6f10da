#include "solvers/estimators/formula_program.hpp"

#include "solvers/estimators/formula_value.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

namespace {

constexpr unsigned most_whole_power = 64;

/// By the interpreter itself, so that it does not matter who computes.
double value_of(KOperation operation, double a, double b) {
  SolverOptions options;
  KFormula& formula = options.k_formula;
  formula.constants = {a, b};
  formula.instructions[0] = {KOperation::Constant, 0};
  formula.instructions[1] = {KOperation::Constant, 1};
  formula.instructions[2] = {operation, 0, 1};
  formula.size = 3;
  formula.result = 2;
  const KContext<double, 2> nothing{{}, {}, 0.0, 0.0, {}, {}, {}, 0.0, 0, nullptr, options};
  return formula_value(formula, nothing, {})[0];
}

}  // namespace

FormulaTerm FormulaProgram::quantity(std::size_t index, std::size_t at) {
  const auto operation = static_cast<KOperation>(static_cast<std::size_t>(KOperation::Sigma2) + index);
  note_need(operation);
  return emit({operation, 0, 0, index >= first_formula_vector}, at);
}

FormulaTerm FormulaProgram::call(const FormulaFunction& function, const std::vector<FormulaTerm>& arguments,
                                 std::size_t at) {
  const std::size_t count = arguments.size();
  const auto wrong_count = [&](const char* takes) {
    return text_.error(at, quoted(function.name) + " takes " + takes + ", not " + std::to_string(count));
  };
  const FormulaTerm& first = arguments.front();
  if (function.takes == FormulaTakes::One) {
    if (count != 1) throw wrong_count("one value");
    return of_one(function.operation, first, at);
  }
  if (function.takes == FormulaTakes::ComponentsOrMore && count > 1) {
    FormulaTerm all = first;
    for (std::size_t i = 1; i < count; ++i) all = of_two(function.of_two, all, arguments[i], at);
    return all;
  }
  if (count != 1) throw wrong_count("one quantity by component");
  if (!first.by_component) {
    const char* const more = function.takes == FormulaTakes::ComponentsOrMore ? ", or several values" : "";
    throw text_.error(at, quoted(function.name) +
                              " takes a quantity by component (alpha, gradient, diagonal, eigenvalues)" + more +
                              ", and this is one number");
  }
  return emit({function.operation, first.instruction, 0, false}, at);
}

FormulaTerm FormulaProgram::of_one(KOperation operation, const FormulaTerm& a, std::size_t at) {
  if (a.number) return folded(operation, *a.number, 0.0, at);
  return emit({operation, a.instruction, 0, a.by_component}, at);
}

FormulaTerm FormulaProgram::of_two(KOperation operation, const FormulaTerm& a, const FormulaTerm& b, std::size_t at) {
  if (a.number && b.number) return folded(operation, *a.number, *b.number, at);
  return emit({operation, instruction_of(a, at), instruction_of(b, at), a.by_component || b.by_component}, at);
}

FormulaTerm FormulaProgram::power(const FormulaTerm& base, const FormulaTerm& exponent, std::size_t at) {
  if (!exponent.number) return of_two(KOperation::Power, base, exponent, at);
  const double size = std::fabs(*exponent.number);
  if (size != 0.5 && (size != std::floor(size) || size > most_whole_power))
    return of_two(KOperation::Power, base, exponent, at);
  const FormulaTerm positive =
      size == 0.5 ? of_one(KOperation::Sqrt, base, at) : whole_power(base, static_cast<std::uint8_t>(size), at);
  return *exponent.number < 0.0 ? of_two(KOperation::Divide, {1.0}, positive, at) : positive;
}

FormulaTerm FormulaProgram::whole_power(const FormulaTerm& base, std::uint8_t exponent, std::size_t at) {
  if (base.number) return finite(formula_whole_power(*base.number, exponent), at);
  if (exponent == 1) return base;
  return emit({KOperation::WholePower, base.instruction, exponent, base.by_component}, at);
}

FormulaTerm FormulaProgram::folded(KOperation operation, double a, double b, std::size_t at) const {
  return finite(value_of(operation, a, b), at);
}

FormulaTerm FormulaProgram::finite(double value, std::size_t at) const {
  if (!std::isfinite(value)) throw text_.error(at, "this is not a finite number");
  return {value};
}

void FormulaProgram::note_need(KOperation operation) {
  const bool is_known_before =
      operation == KOperation::Observations || operation == KOperation::Unknowns || operation == KOperation::Iteration;
  if (!is_known_before) formula_.needs_ols_step = true;
  if (operation == KOperation::Squares) formula_.needs_squares = true;
  if (operation == KOperation::Eigenvalues) formula_.needs_eigenvalues = true;
}

std::uint8_t FormulaProgram::instruction_of(const FormulaTerm& term, std::size_t at) {
  if (!term.number) return term.instruction;
  const auto known =
      std::ranges::find(formula_.constants.begin(), formula_.constants.begin() + constants_, *term.number);
  const auto index = static_cast<std::size_t>(known - formula_.constants.begin());
  if (index == constants_) {
    if (constants_ == KFormula::most_constants) throw too_long(at, KFormula::most_constants, "different numbers");
    formula_.constants[constants_++] = *term.number;
  }
  return emit({KOperation::Constant, static_cast<std::uint8_t>(index), 0, false}, at).instruction;
}

FormulaTerm FormulaProgram::emit(const KInstruction& instruction, std::size_t at) {
  const auto same = [&](const KInstruction& other) {
    return other.operation == instruction.operation && other.a == instruction.a && other.b == instruction.b;
  };
  const auto end = formula_.instructions.begin() + formula_.size;
  const auto known = std::find_if(formula_.instructions.begin(), end, same);
  const auto index = static_cast<std::uint8_t>(known - formula_.instructions.begin());
  if (known == end) {
    if (formula_.size == KFormula::most_instructions)
      throw too_long(at, KFormula::most_instructions, "different operations");
    formula_.instructions[formula_.size++] = instruction;
  }
  return {std::nullopt, index, instruction.by_component};
}

FormulaError FormulaProgram::too_long(std::size_t at, std::size_t most, const char* of) const {
  return text_.error(at,
                     "here it has more than " + std::to_string(most) + ' ' + of + ", which are all that are allowed");
}

KFormula FormulaProgram::finish(const FormulaTerm& result) {
  formula_.result = instruction_of(result, 0);
  return formula_;
}

}  // namespace ridgeloc::solvers
