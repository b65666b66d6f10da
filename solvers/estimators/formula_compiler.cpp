#include "solvers/estimators/formula_compiler.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "solvers/estimators/formula_names.hpp"
#include "solvers/estimators/formula_program.hpp"
#include "solvers/estimators/formula_text.hpp"

namespace ridgeloc::solvers {

namespace {

/// The grammar of compile_k, by recursive descent.
class Parser {
 public:
  explicit Parser(std::string_view text) : text_(text), program_(text_) {}

  KFormula parse() {
    if (text_.at_end())
      throw FormulaError(
          "a formula is missing, for example \"p * sigma2 / sum(alpha^2)\"; `ridgeloc list k` has the names");
    const FormulaTerm result = read_sum();
    if (!text_.at_end()) text_.refuse_rest();
    return program_.finish(result);
  }

 private:
  FormulaTerm read_sum() {
    FormulaTerm left = read_product();
    for (;;) {
      const std::size_t at = text_.position();
      if (text_.takes('+')) {
        left = program_.of_two(KOperation::Add, left, read_product(), at);
      } else if (text_.takes('-')) {
        left = program_.of_two(KOperation::Subtract, left, read_product(), at);
      } else {
        return left;
      }
    }
  }

  FormulaTerm read_product() {
    FormulaTerm left = read_signed();
    for (;;) {
      const std::size_t at = text_.position();
      if (text_.takes('*')) {
        left = program_.of_two(KOperation::Multiply, left, read_signed(), at);
      } else if (text_.takes('/')) {
        left = program_.of_two(KOperation::Divide, left, read_signed(), at);
      } else {
        return left;
      }
    }
  }

  FormulaTerm read_signed() {
    const std::size_t at = text_.position();
    if (text_.takes('+')) return read_signed();
    if (text_.takes('-')) return program_.of_one(KOperation::Negate, read_signed(), at);
    return read_power();
  }

  FormulaTerm read_power() {
    const FormulaTerm base = read_value();
    const std::size_t at = text_.position();
    return text_.takes('^') ? program_.power(base, read_signed(), at) : base;
  }

  FormulaTerm read_value() {
    if (text_.sees_number()) return {text_.take_number()};
    if (text_.sees_name()) return read_named();
    const std::size_t open = text_.position();
    if (!text_.takes('(')) text_.refuse_value();
    const FormulaTerm inside = read_sum();
    close(open);
    return inside;
  }

  FormulaTerm read_named() {
    const std::size_t at = text_.position();
    const std::string_view name = text_.take_name();
    const auto function = std::ranges::find(formula_function_table, name, &FormulaFunction::name);
    const auto quantity = std::ranges::find(formula_quantity_table, name, &FormulaName::name);
    if (function == formula_function_table.end() && quantity == formula_quantity_table.end())
      throw unknown_name(at, name);
    const std::size_t open = text_.position();
    if (function != formula_function_table.end()) {
      if (!text_.takes('('))
        throw text_.error(at, quoted(name) + " is a function: write " + std::string(function->shown.name));
      return program_.call(*function, read_arguments(open), at);
    }
    if (text_.sees('('))
      throw text_.error(open, quoted(name) + " is a quantity and no function; write * for a product");
    return program_.quantity(static_cast<std::size_t>(quantity - formula_quantity_table.begin()), at);
  }

  std::vector<FormulaTerm> read_arguments(std::size_t open) {
    std::vector<FormulaTerm> arguments;
    do {
      arguments.push_back(read_sum());
    } while (text_.takes(','));
    close(open);
    return arguments;
  }

  void close(std::size_t open) {
    if (text_.takes(')')) return;
    if (text_.at_end()) throw text_.error(open, "this \"(\" is not closed");
    if (text_.sees(','))
      throw text_.error(text_.position(), "a comma separates values of a function; numbers have a point, 0.5");
    throw text_.error(text_.position(), "an operator or \")\" is missing before " + text_.rest());
  }

  [[nodiscard]] FormulaError unknown_name(std::size_t position, std::string_view name) const {
    FormulaError unknown = text_.error(position, "there is no " + quoted(name));
    unknown.unknown = name;
    for (const FormulaName& quantity : formula_quantity_table) unknown.candidates.emplace_back(quantity.name);
    for (const FormulaFunction& function : formula_function_table) unknown.candidates.emplace_back(function.name);
    return unknown;
  }

  FormulaText text_;
  FormulaProgram program_;
};

}  // namespace

std::span<const FormulaName> formula_quantities() {
  return formula_quantity_table;
}

std::span<const FormulaName> formula_functions() {
  static constexpr auto shown = [] {
    std::array<FormulaName, formula_function_table.size()> names{};
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = formula_function_table[i].shown;
    return names;
  }();
  return shown;
}

KFormula compile_k(std::string_view text) {
  if (text.size() > KFormula::most_characters) {
    throw FormulaError("it is " + std::to_string(text.size()) + " characters long, " +
                       std::to_string(KFormula::most_characters) + " at most are allowed");
  }
  return Parser(text).parse();
}

}  // namespace ridgeloc::solvers
