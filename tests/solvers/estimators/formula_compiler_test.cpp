// What is compiled of a formula of K, and what is refused and where.

#include "solvers/estimators/formula_compiler.hpp"

#include <algorithm>
#include <string>
#include <vector>

#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

std::string refusal(const std::string& text) {
  try {
    solvers::compile_k(text);
  } catch (const solvers::FormulaError& error) {
    return error.what();
  }
  return "accepted";
}

}  // namespace

TEST_CASE("a formula asks for what it names and computes what it repeats once") {
  CHECK_FALSE(solvers::compile_k("0.5 ^ iteration * n / p").needs_ols_step);
  CHECK(solvers::compile_k("sigma2").needs_ols_step);
  CHECK_FALSE(solvers::compile_k("sigma2 * trace").needs_squares);
  CHECK(solvers::compile_k("squares / n").needs_squares);
  CHECK_FALSE(solvers::compile_k("sum(alpha * diagonal)").needs_eigenvalues);
  CHECK(solvers::compile_k("sum(eigenvalues)").needs_eigenvalues);
  // alpha, alpha^2, its sum, and the sum of two of these.
  CHECK(static_cast<int>(solvers::compile_k("sum(alpha^2) + sum(alpha^2)").size) == 4);
}

TEST_CASE("what is wrong with a formula is said, and where") {
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {"", "a formula is missing, for example \"p * sigma2"},
      {" \n ", "a formula is missing"},
      {"sigma2 * tracee / n", "column 10: there is no \"tracee\""},
      {"sigma2 *\n  tracee", "line 2, column 3: there is no \"tracee\""},
      {"Sigma2", "column 1: there is no \"Sigma2\""},
      {"sigma2 / (n - p", "column 10: this \"(\" is not closed"},
      {"max(alpha", "column 4: this \"(\" is not closed"},
      {"sigma2)", "column 7: this \")\" closes nothing"},
      {"sigma2 n", "column 8: an operator is missing before \"n\""},
      {"2 n", "column 3: an operator is missing before \"n\""},
      {"1.5.2", "column 4: an operator is missing before \".2\""},
      {"(1 2)", "column 4: an operator or \")\" is missing before \"2\""},
      {"sigma2 +", "column 9: the formula ends where a number, a quantity, a function or \"(\" is missing"},
      {"sigma2 + * n", "column 10: a number, a quantity, a function or \"(\" is missing before \"*\""},
      {"alpha ** 2", "column 7: a power is written ^, not **"},
      {"()", "column 2: a number, a quantity, a function or \"(\" is missing before \")\""},
      {"sigma2 $ n", "column 8: an operator is missing before \"$\""},
      {"\xc2\xb5", "column 1: a number, a quantity, a function or \"(\" is missing before \"\xc2\xb5\""},
      {"0,5 * n", "column 2: a comma separates values of a function; numbers have a point, 0.5"},
      {"(0,5) * n", "column 3: a comma separates values of a function; numbers have a point, 0.5"},
      {".", "column 1: \".\" is not a number"},
      {"1e999", "column 1: \"1e999\" is a number too large"},
      {"1e-999", "column 1: \"1e-999\" is a number too large or too close to zero"},
      {"2 * 1 / 0", "column 7: this is not a finite number"},
      {"log(-1)", "column 1: this is not a finite number"},
      {"(-2) ^ 0.3", "column 6: this is not a finite number"},
      {"sqrt", "column 1: \"sqrt\" is a function: write sqrt(x)"},
      {"sqrt * 2", "column 1: \"sqrt\" is a function: write sqrt(x)"},
      {"sigma2(n)", "column 7: \"sigma2\" is a quantity and no function; write * for a product"},
      {"sqrt(n, p)", "column 1: \"sqrt\" takes one value, not 2"},
      {"1 + sum(alpha, gradient)", "column 5: \"sum\" takes one quantity by component, not 2"},
      {"mean(sigma2)",
       "column 1: \"mean\" takes a quantity by component (alpha, gradient, diagonal, eigenvalues), and "
       "this is one number"},
      {"max(3)",
       "column 1: \"max\" takes a quantity by component (alpha, gradient, diagonal, eigenvalues), or several "
       "values, and this is one number"},
      {"sqrt()", "column 6: a number, a quantity, a function or \"(\" is missing before \")\""},
  }));
  INFO(text);
  CHECK(refusal(text).starts_with(message));
}

TEST_CASE("unknown names in formulas come with those that there are") {
  try {
    solvers::compile_k("2 * geomeen(alpha)");
    FAIL("accepted");
  } catch (const solvers::FormulaError& error) {
    CHECK(error.unknown == "geomeen");
    for (const char* name : {"geomean", "sigma2", "eigenvalues", "min"})
      CHECK(std::ranges::count(error.candidates, name) == 1);
  }
}

TEST_CASE("a formula has a largest size") {
  std::string longest(solvers::KFormula::most_characters, ' ');
  longest.front() = 'n';
  CHECK(refusal(longest) == "accepted");
  CHECK(refusal(longest + " ") == "it is 501 characters long, 500 at most are allowed");
  const std::string nested = std::string(249, '(') + "n" + std::string(249, ')');
  CHECK(refusal(nested) == "accepted");
  CHECK(refusal(std::string(499, '-') + "n").starts_with("column 436: here it has more than 64 different operations"));

  // n, 2, n + 2, 3, n + 2 + 3, ...: sixteen numbers.
  std::string numbers = "n";
  for (int i = 1; i <= 16; ++i) numbers.append("+").append(std::to_string(i));
  CHECK(refusal(numbers) == "accepted");
  CHECK(refusal(numbers + "+ 16 + 1") == "accepted");
  CHECK(refusal(numbers + "+ 17").starts_with("column 41: here it has more than 16 different numbers"));

  // A tower of powers is one of numbers; sums of 64 operations are not too many.
  std::string powers = "alpha";
  for (int i = 0; i < 63; ++i) powers += "^2";
  CHECK(refusal(powers) == "column 124: this is not a finite number");  // 2^(2^(2^...))
  std::string sums = "n";
  for (int i = 0; i < 63; ++i) sums += "+n";
  CHECK(refusal(sums) == "accepted");
  CHECK(refusal(sums + "+n").starts_with("column 128: here it has more than 64 different operations"));
}
