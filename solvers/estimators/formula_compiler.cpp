#include "solvers/estimators/formula_compiler.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "solvers/estimators/formula_value.hpp"
#include "solvers/options.hpp"

namespace ridgeloc::solvers {

namespace {

/// In the order of KOperation, from Sigma2 on; the last four are by component.
constexpr std::array<FormulaName, 10> quantities = {{
    {"sigma2", "variance of a residual of weight 1, as sigma2_source says"},
    {"n", "number of observations"},
    {"p", "number of unknowns"},
    {"iteration", "steps taken before this one: 0, 1, ..."},
    {"trace", "trace of J'WJ, the sum of its eigenvalues"},
    {"squares", "e'We at the iterate"},
    {"alpha", "by component: the least-squares step dx_ls, 1e-9 m long at least"},
    {"gradient", "by component: J'We"},
    {"diagonal", "by component: the diagonal of J'WJ"},
    {"eigenvalues", "by component: those of J'WJ; K is in canonical coordinates then, and so are all quantities"},
}};
constexpr std::size_t first_by_component = 6;

/// How a function is called.
enum class Takes { One, TwoOrMore, Components, ComponentsOrMore };

struct Function {
  FormulaName shown;
  std::string_view name;
  Takes takes;
  KOperation operation;           ///< of one value, of two, or of components
  KOperation of_two = operation;  ///< of ComponentsOrMore, where there are two values or more
};

constexpr std::array<Function, 10> functions = {{
    {{"sqrt(x)", "square root"}, "sqrt", Takes::One, KOperation::Sqrt},
    {{"log(x)", "natural logarithm"}, "log", Takes::One, KOperation::Log},
    {{"exp(x)", "exponential function"}, "exp", Takes::One, KOperation::Exp},
    {{"abs(x)", "absolute value"}, "abs", Takes::One, KOperation::Abs},
    {{"min(x, y, ...)", "the smallest of several values; min(v): of the components of v"},
     "min",
     Takes::ComponentsOrMore,
     KOperation::Smallest,
     KOperation::Min},
    {{"max(x, y, ...)", "the largest of several values; max(v): of the components of v"},
     "max",
     Takes::ComponentsOrMore,
     KOperation::Largest,
     KOperation::Max},
    {{"sum(v)", "sum of the components"}, "sum", Takes::Components, KOperation::Sum},
    {{"mean(v)", "their arithmetic mean"}, "mean", Takes::Components, KOperation::Mean},
    {{"geomean(v)", "their geometric mean"}, "geomean", Takes::Components, KOperation::GeometricMean},
    {{"median(v)", "their median, of an even number the mean of the middle two"},
     "median",
     Takes::Components,
     KOperation::Median},
}};

constexpr unsigned most_whole_power = 64;

/// A number that is known now, or the value of an instruction.
struct Term {
  std::optional<double> number;
  std::uint8_t instruction = 0;
  bool by_component = false;
};

bool is_digit(char c) {
  return '0' <= c && c <= '9';
}
bool begins_name(char c) {
  return ('a' <= c && c <= 'z') || ('A' <= c && c <= 'Z') || c == '_';
}
bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r';
}

std::string quoted(std::string_view text) {
  return '"' + std::string(text) + '"';
}

class Compiler {
 public:
  explicit Compiler(std::string_view text) : text_(text) { formula_.size = 0; }

  KFormula compile() {
    if (text_.size() > KFormula::most_characters) {
      throw FormulaError("it is " + std::to_string(text_.size()) + " characters long, " +
                         std::to_string(KFormula::most_characters) + " at most are allowed");
    }
    skip_spaces();
    if (at_end())
      throw FormulaError(
          "a formula is missing, for example \"p * sigma2 / sum(alpha^2)\"; `ridgeloc list k` has the names");
    const Term result = read_sum();
    if (!at_end()) refuse_rest();
    formula_.result = instruction_of(result, 0);
    return formula_;
  }

 private:
  // What the text has next.

  bool at_end() const { return next_ == text_.size(); }
  bool sees(char c) const { return !at_end() && text_[next_] == c; }
  void skip_spaces() {
    while (!at_end() && is_space(text_[next_])) ++next_;
  }
  bool takes(char c) {
    if (!sees(c)) return false;
    ++next_;
    skip_spaces();
    return true;
  }
  std::string_view take_name() {
    const std::size_t begin = next_;
    while (!at_end() && (begins_name(text_[next_]) || is_digit(text_[next_]))) ++next_;
    const std::string_view name = text_.substr(begin, next_ - begin);
    skip_spaces();
    return name;
  }

  // What is wrong, and where.

  std::string place(std::size_t position) const {
    const std::string_view before = text_.substr(0, position);
    const std::size_t break_before = before.rfind('\n');
    const std::size_t column = break_before == std::string_view::npos ? position : position - break_before - 1;
    const std::string where = "column " + std::to_string(column + 1);
    if (text_.find('\n') == std::string_view::npos) return where;
    return "line " + std::to_string(std::ranges::count(before, '\n') + 1) + ", " + where;
  }
  [[nodiscard]] FormulaError error(std::size_t position, const std::string& what) const {
    return FormulaError(place(position) + ": " + what);
  }
  /// The text from here to the next space, as messages quote it: ends a formula that goes on where it may not.
  std::string rest() const {
    std::size_t end = next_ + 1;
    const bool in_word = begins_name(text_[next_]) || is_digit(text_[next_]) || text_[next_] == '.';
    while (in_word && end < text_.size() && (begins_name(text_[end]) || is_digit(text_[end]) || text_[end] == '.'))
      ++end;
    // A character of UTF-8 is not cut.
    while (end < text_.size() && (static_cast<unsigned char>(text_[end]) & 0xC0U) == 0x80U) ++end;
    return quoted(text_.substr(next_, end - next_));
  }
  [[noreturn]] void refuse_rest() const {
    if (sees(')')) throw error(next_, "this \")\" closes nothing");
    if (sees(',')) throw error(next_, "a comma separates values of a function; numbers have a point, 0.5");
    throw error(next_, "an operator is missing before " + rest() + "; allowed: + - * / ^");
  }
  [[noreturn]] void refuse_value() const {
    const char* const expected = "a number, a quantity, a function or \"(\" is missing";
    if (at_end()) throw error(next_, std::string("the formula ends where ") + expected);
    if (sees('*') && next_ > 0 && text_[next_ - 1] == '*') throw error(next_ - 1, "a power is written ^, not **");
    throw error(next_, std::string(expected) + " before " + rest());
  }
  [[nodiscard]] FormulaError unknown_name(std::size_t position, std::string_view name) const {
    FormulaError unknown = error(position, "there is no " + quoted(name));
    unknown.unknown = name;
    for (const FormulaName& quantity : quantities) unknown.candidates.emplace_back(quantity.name);
    for (const Function& function : functions) unknown.candidates.emplace_back(function.name);
    return unknown;
  }

  // The grammar.

  Term read_sum() {
    Term left = read_product();
    for (;;) {
      const std::size_t at = next_;
      if (takes('+')) {
        left = of_two(KOperation::Add, left, read_product(), at);
      } else if (takes('-')) {
        left = of_two(KOperation::Subtract, left, read_product(), at);
      } else {
        return left;
      }
    }
  }

  Term read_product() {
    Term left = read_signed();
    for (;;) {
      const std::size_t at = next_;
      if (takes('*')) {
        left = of_two(KOperation::Multiply, left, read_signed(), at);
      } else if (takes('/')) {
        left = of_two(KOperation::Divide, left, read_signed(), at);
      } else {
        return left;
      }
    }
  }

  Term read_signed() {
    const std::size_t at = next_;
    if (takes('+')) return read_signed();
    if (takes('-')) return of_one(KOperation::Negate, read_signed(), at);
    return read_power();
  }

  Term read_power() {
    const Term base = read_value();
    const std::size_t at = next_;
    return takes('^') ? power(base, read_signed(), at) : base;
  }

  Term read_value() {
    if (at_end()) refuse_value();
    if (is_digit(text_[next_]) || text_[next_] == '.') return read_number();
    if (begins_name(text_[next_])) return read_named();
    const std::size_t open = next_;
    if (!takes('(')) refuse_value();
    const Term inside = read_sum();
    close(open);
    return inside;
  }

  Term read_number() {
    double number = 0.0;
    const char* const begin = text_.data() + next_;
    const auto [end, failure] = std::from_chars(begin, text_.data() + text_.size(), number);
    if (failure == std::errc::invalid_argument) throw error(next_, rest() + " is not a number");
    if (failure == std::errc::result_out_of_range)
      throw error(next_, quoted({begin, end}) + " is a number too large or too close to zero");
    next_ += static_cast<std::size_t>(end - begin);
    skip_spaces();
    return {number};
  }

  Term read_named() {
    const std::size_t at = next_;
    const std::string_view name = take_name();
    const auto function = std::ranges::find(functions, name, &Function::name);
    const auto quantity = std::ranges::find(quantities, name, &FormulaName::name);
    if (function == functions.end() && quantity == quantities.end()) throw unknown_name(at, name);
    const std::size_t open = next_;
    if (function != functions.end()) {
      if (!takes('(')) throw error(at, quoted(name) + " is a function: write " + std::string(function->shown.name));
      return call(*function, read_arguments(open), at);
    }
    if (sees('(')) throw error(open, quoted(name) + " is a quantity and no function; write * for a product");
    const auto index = static_cast<std::size_t>(quantity - quantities.begin());
    const auto operation = static_cast<KOperation>(static_cast<std::size_t>(KOperation::Sigma2) + index);
    note_need(operation);
    return emit({operation, 0, 0, index >= first_by_component}, at);
  }

  std::vector<Term> read_arguments(std::size_t open) {
    std::vector<Term> arguments;
    do {
      arguments.push_back(read_sum());
    } while (takes(','));
    close(open);
    return arguments;
  }

  void close(std::size_t open) {
    if (takes(')')) return;
    if (at_end()) throw error(open, "this \"(\" is not closed");
    if (sees(',')) throw error(next_, "a comma separates values of a function; numbers have a point, 0.5");
    throw error(next_, "an operator or \")\" is missing before " + rest());
  }

  // What is computed.

  Term call(const Function& function, const std::vector<Term>& arguments, std::size_t at) {
    const std::size_t count = arguments.size();
    const auto wrong_count = [&](const char* takes) {
      return error(at, quoted(function.name) + " takes " + takes + ", not " + std::to_string(count));
    };
    const Term& first = arguments.front();
    if (function.takes == Takes::One) {
      if (count != 1) throw wrong_count("one value");
      return of_one(function.operation, first, at);
    }
    if (function.takes == Takes::ComponentsOrMore && count > 1) {
      Term all = first;
      for (std::size_t i = 1; i < count; ++i) all = of_two(function.of_two, all, arguments[i], at);
      return all;
    }
    if (count != 1) throw wrong_count("one quantity by component");
    if (!first.by_component) {
      const char* const more = function.takes == Takes::ComponentsOrMore ? ", or several values" : "";
      throw error(at, quoted(function.name) +
                          " takes a quantity by component (alpha, gradient, diagonal, eigenvalues)" + more +
                          ", and this is one number");
    }
    return emit({function.operation, first.instruction, 0, false}, at);
  }

  Term of_one(KOperation operation, const Term& a, std::size_t at) {
    if (a.number) return folded(operation, *a.number, 0.0, at);
    return emit({operation, a.instruction, 0, a.by_component}, at);
  }

  Term of_two(KOperation operation, const Term& a, const Term& b, std::size_t at) {
    if (a.number && b.number) return folded(operation, *a.number, *b.number, at);
    return emit({operation, instruction_of(a, at), instruction_of(b, at), a.by_component || b.by_component}, at);
  }

  /// Whole powers up to 64 and square roots are exact to rounding and fast; others are e^(y log x).
  Term power(const Term& base, const Term& exponent, std::size_t at) {
    if (!exponent.number) return of_two(KOperation::Power, base, exponent, at);
    const double size = std::fabs(*exponent.number);
    if (size != 0.5 && (size != std::floor(size) || size > most_whole_power))
      return of_two(KOperation::Power, base, exponent, at);
    const Term positive =
        size == 0.5 ? of_one(KOperation::Sqrt, base, at) : whole_power(base, static_cast<std::uint8_t>(size), at);
    return *exponent.number < 0.0 ? of_two(KOperation::Divide, {1.0}, positive, at) : positive;
  }

  Term whole_power(const Term& base, std::uint8_t exponent, std::size_t at) {
    if (base.number) return finite(formula_whole_power(*base.number, exponent), at);
    if (exponent == 1) return base;
    return emit({KOperation::WholePower, base.instruction, exponent, base.by_component}, at);
  }

  Term folded(KOperation operation, double a, double b, std::size_t at) const {
    return finite(value_of(operation, a, b), at);
  }

  Term finite(double value, std::size_t at) const {
    if (!std::isfinite(value)) throw error(at, "this is not a finite number");
    return {value};
  }

  /// By the interpreter itself, so that it does not matter who computes.
  static double value_of(KOperation operation, double a, double b) {
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

  void note_need(KOperation operation) {
    const bool is_known_before = operation == KOperation::Observations || operation == KOperation::Unknowns ||
                                 operation == KOperation::Iteration;
    if (!is_known_before) formula_.needs_ols_step = true;
    if (operation == KOperation::Squares) formula_.needs_squares = true;
    if (operation == KOperation::Eigenvalues) formula_.needs_eigenvalues = true;
  }

  std::uint8_t instruction_of(const Term& term, std::size_t at) {
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

  Term emit(const KInstruction& instruction, std::size_t at) {
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

  FormulaError too_long(std::size_t at, std::size_t most, const char* of) const {
    return error(at, "here it has more than " + std::to_string(most) + ' ' + of + ", which are all that are allowed");
  }

  std::string_view text_;
  std::size_t next_ = 0;
  KFormula formula_;
  std::uint8_t constants_ = 0;
};

}  // namespace

std::span<const FormulaName> formula_quantities() {
  return quantities;
}

std::span<const FormulaName> formula_functions() {
  static constexpr auto shown = [] {
    std::array<FormulaName, functions.size()> names{};
    for (std::size_t i = 0; i < names.size(); ++i) names[i] = functions[i].shown;
    return names;
  }();
  return shown;
}

KFormula compile_k(std::string_view text) {
  return Compiler(text).compile();
}

}  // namespace ridgeloc::solvers
