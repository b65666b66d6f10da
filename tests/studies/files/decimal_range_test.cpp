#include "studies/files/decimal_range.hpp"

#include <vector>

#include "tests/support/catch.hpp"

using ridgeloc::studies::decimal_range;

using Numbers = std::vector<double>;

TEST_CASE("a range has the numbers that one would type") {
  CHECK(decimal_range(0.1, 0.5, 0.1, 100).values == Numbers{0.1, 0.2, 0.3, 0.4, 0.5});
  CHECK(decimal_range(3, 7, 2, 100).values == Numbers{3, 5, 7});
  CHECK(decimal_range(0.3, -0.3, -0.15, 100).values == Numbers{0.3, 0.15, 0, -0.15, -0.3});
  CHECK(decimal_range(1e-7, 3e-7, 1e-7, 100).values == Numbers{1e-7, 2e-7, 3e-7});
  CHECK(decimal_range(1e20, 3e20, 1e20, 100).values == Numbers{1e20, 2e20, 3e20});
  CHECK(decimal_range(2.5, 2.5, 1, 100).values == Numbers{2.5});
  CHECK(decimal_range(1e8, 1.00000002e8, 1, 100).values == Numbers{1e8, 100000001, 100000002});
  for (int i = 0; i <= 1000; ++i) CHECK(decimal_range(0, 1, 0.001, 1001).values[i] == i / 1000.0);
}

TEST_CASE("a range keeps every digit of where it begins") {
  const auto long_numbers = decimal_range(0.12345678901234567, 2.12345678901234567, 1, 100);
  CHECK(long_numbers.values == Numbers{0.12345678901234567, 1.12345678901234567, 2.12345678901234567});
  CHECK(long_numbers.reaches_end);
  CHECK(decimal_range(1234567.890123456, 1234568.890123456, 0.5, 100).values ==
        Numbers{1234567.890123456, 1234568.390123456, 1234568.890123456});
  CHECK(decimal_range(1, 1.0000000001, 1e-12, 1000).values.size() == 101);
}

TEST_CASE("a range says whether it ends where it is to, and where it goes on") {
  const auto missed = decimal_range(0.1, 0.35, 0.1, 100);
  CHECK(missed.values == Numbers{0.1, 0.2, 0.3});
  CHECK_FALSE(missed.reaches_end);
  CHECK(missed.beyond == 0.4);
  CHECK(decimal_range(0.1, 0.7, 0.1, 100).reaches_end);
  CHECK(decimal_range(-1, 1, 0.1, 100).reaches_end);
  CHECK(decimal_range(-1, 1, 0.1, 100).values[10] == 0.0);
  CHECK_FALSE(decimal_range(0.1, 0.70000000000000007, 0.1, 100).reaches_end);
}

TEST_CASE("what is no range, or too long a one, has no numbers") {
  CHECK(decimal_range(3, 2, 1, 100).values.empty());
  CHECK(decimal_range(2, 3, -1, 100).values.empty());
  CHECK(decimal_range(3, 4, 0, 100).values.empty());
  CHECK(decimal_range(0, 100, 1, 100).values.empty());
  CHECK(decimal_range(0, 99, 1, 100).values.size() == 100);
  CHECK(decimal_range(1, 1e300, 1e-300, 100).values.empty());
  CHECK(decimal_range(0, 5e-324, 5e-324, 100).values == Numbers{0, 5e-324});
}
