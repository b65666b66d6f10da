#include "results/schema/text.hpp"

#include <cstdlib>
#include <limits>

#include "tests/support/catch.hpp"
#include "tests/support/numbers.hpp"
#include "tests/support/synthetic_summary.hpp"

namespace {

using namespace ridgeloc::results;
using ridgeloc::tests::infinity;
using ridgeloc::tests::not_a_number;

TEST_CASE("factor values and cells as people write them") {
  CHECK(factor_text(std::int64_t{3}) == "3");
  CHECK(factor_text(0.1) == "0.1");
  CHECK(factor_text(1.0) == "1");
  CHECK(factor_text(std::string("street")) == "street");
  CHECK(cell_text(synthetic_summary().header, 1) == "points = 3, range_sigma_m = 0.5");
}

TEST_CASE("counts agree with their noun") {
  CHECK(count_text(0, "cell") == "0 cells");
  CHECK(count_text(1, "cell") == "1 cell");
  CHECK(count_text(12, "thread") == "12 threads");
}

TEST_CASE("exact text reads back as the same bits") {
  for (const double value : {0.1, 1.0 / 3.0, 1e300, 5e-324, -2.5})
    CHECK(std::strtod(exact_text(value).c_str(), nullptr) == value);
  CHECK(exact_text(-not_a_number) == "nan");
  CHECK(exact_text(infinity) == "inf");
  CHECK(exact_text(-infinity) == "-inf");
}

TEST_CASE("a value is rounded to the second digit of its error") {
  CHECK(text_with_error(0.135234, 0.00123) == "0.1352 ± 0.0012");
  CHECK(text_with_error(12.5, 0.996) == "12.5 ± 1.0");
  CHECK(text_with_error(1234.4, 56.0) == "1234 ± 56");
  CHECK(text_with_error(-0.5, 0.25) == "-0.50 ± 0.25");
  CHECK(text_with_error(1.352e-9, 1.2e-11) == "(1.352 ± 0.012)e-09");
  CHECK(text_with_error(2.0e8, 3.0e6) == "(2.000 ± 0.030)e+08");
}

TEST_CASE("errors that are zero, unknown or infinite are said") {
  CHECK(text_with_error(2.5, 0.0) == "2.5 ± 0");
  CHECK(text_with_error(2.5, not_a_number) == "2.5 ± ?");
  CHECK(text_with_error(not_a_number, not_a_number) == "-");
  CHECK(text_with_error(2.5, infinity) == "2.5 ± inf");
}

TEST_CASE("an error in units of the last digit") {
  CHECK(text_with_digits(0.135234, 0.00123) == "0.1352(12)");
  CHECK(text_with_digits(12.5, 0.996) == "12.5(10)");
  CHECK(text_with_digits(1234.4, 56.0) == "1234(56)");
  CHECK(text_with_digits(1.352e-9, 1.2e-11) == "1.352(12)e-09");
  CHECK(text_with_digits(2.5, 0.0) == "2.5");
  CHECK(text_with_digits(2.5, not_a_number) == "2.5(?)");
  CHECK(text_with_digits(2.5, infinity) == "2.5(inf)");
  CHECK(text_with_digits(infinity, infinity) == "inf");
  CHECK(text_with_digits(not_a_number, 0.1) == "-");
}

TEST_CASE("a value with its interval") {
  CHECK(text_with_interval(0.97, 0.9152, 0.9897) == "0.970 [0.915, 0.990]");
  CHECK(text_with_interval(2.0, 2.0, 2.0) == "2 [2, 2]");
  CHECK(text_with_interval(3.0, 1.5, infinity) == "3 [1.5, inf]");
  CHECK(text_with_interval(not_a_number, not_a_number, not_a_number) == "-");
}

TEST_CASE("display width counts characters, not bytes") {
  CHECK(display_width("1 ± 2") == 5);
  CHECK(display_width("") == 0);
}

}  // namespace
