#include "core/elementary.hpp"

#include <cmath>
#include <random>

#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

/// Distance of `value` from `exact` in units in the last place of `exact`.
double error_ulp(double value, long double exact) {
  const double rounded = static_cast<double>(exact);
  const double ulp = std::nextafter(std::fabs(rounded), INFINITY) - std::fabs(rounded);
  return static_cast<double>(std::fabs(static_cast<long double>(value) - exact)) / ulp;
}

}  // namespace

TEST_CASE("log stays within its stated error") {
  std::mt19937_64 engine(1);
  std::uniform_real_distribution<double> exponent(-1021.0, 1023.0);
  std::uniform_real_distribution<double> near_one(0.5, 2.0);
  double worst = 0.0;
  for (int i = 0; i < 200'000; ++i) {
    for (const double x : {std::exp2(exponent(engine)), near_one(engine)}) {
      worst = std::max(worst, error_ulp(core::log(x), std::log(static_cast<long double>(x))));
    }
  }
  INFO("largest error " << worst << " ulp");
  CHECK(worst <= core::log_max_error_ulp);
  CHECK(core::log(1.0) == 0.0);
  CHECK(core::log(0x1p-53) == Approx(-53.0 * std::log(2.0)).epsilon(1e-15));
}

TEST_CASE("exp and exp_minus_one stay within their stated errors") {
  std::mt19937_64 engine(4);
  std::uniform_real_distribution<double> whole_range(-708.0, 708.0);
  std::uniform_real_distribution<double> near_zero(-2.0, 2.0);
  std::uniform_real_distribution<double> exponent(-300.0, 0.0);
  double worst = 0.0;
  double worst_minus_one = 0.0;
  const auto check = [&](double x) {
    worst = std::max(worst, error_ulp(core::exp(x), std::exp(static_cast<long double>(x))));
    worst_minus_one =
        std::max(worst_minus_one, error_ulp(core::exp_minus_one(x), std::expm1(static_cast<long double>(x))));
  };
  for (int i = 0; i < 200'000; ++i) {
    const double tiny = std::exp2(exponent(engine));
    for (const double x : {whole_range(engine), near_zero(engine), tiny, -tiny}) check(x);
  }
  // Where the exponent changes, what remains of x is largest.
  for (int half = -1021 * 2 + 1; half < 1021 * 2; half += 2) {
    const double x = half * 0.5 * std::log(2.0);
    for (const double near : {std::nextafter(x, -999.0), x, std::nextafter(x, 999.0)}) check(near);
  }
  for (const double x : {-708.0, 708.0}) check(x);
  INFO("largest errors " << worst << " and " << worst_minus_one << " ulp");
  CHECK(worst <= core::exp_max_error_ulp);
  CHECK(worst_minus_one <= core::exp_minus_one_max_error_ulp);
  CHECK(core::exp(0.0) == 1.0);
  CHECK(core::exp_minus_one(0.0) == 0.0);
}

TEST_CASE("powers of two are exact from the smallest normal number to the largest") {
  for (int exponent = -1022; exponent <= 1023; ++exponent) {
    CHECK(core::power_of_two(static_cast<double>(exponent)) == std::ldexp(1.0, exponent));
  }
}

TEST_CASE("sine and cosine of turns stay within their stated error") {
  std::mt19937_64 engine(2);
  std::uniform_real_distribution<double> turns(-1.5, 1.5);
  const long double two_pi = 2.0L * std::acos(-1.0L);
  double worst = 0.0;
  const auto check = [&](double t) {
    const auto value = core::sin_cos_turns(t);
    // Reduced first, so that the reference is exact to its own precision.
    const long double rest = static_cast<long double>(t) - std::nearbyint(static_cast<long double>(t));
    worst = std::max(worst, static_cast<double>(std::fabs(value.sin - std::sin(two_pi * rest))));
    worst = std::max(worst, static_cast<double>(std::fabs(value.cos - std::cos(two_pi * rest))));
  };
  for (int i = 0; i < 200'000; ++i) check(turns(engine));
  for (int eighth = -16; eighth <= 16; ++eighth) {
    const double t = eighth / 8.0;
    for (const double near : {std::nextafter(t, -9.0), t, std::nextafter(t, 9.0)}) check(near);
  }
  INFO("largest error " << worst * 0x1p53 << " * 2^-53");
  CHECK(worst <= core::sin_cos_max_error * 0x1p-53);
}

TEST_CASE("sine and cosine are exact at quarter turns") {
  for (int quarter = -9; quarter <= 9; ++quarter) {
    const auto value = core::sin_cos_turns(quarter / 4.0);
    constexpr double sines[] = {0.0, 1.0, 0.0, -1.0};
    CHECK(value.sin == sines[(quarter % 4 + 4) % 4]);
    CHECK(value.cos == sines[((quarter + 1) % 4 + 4) % 4]);
  }
}

TEST_CASE("inverse cube root stays within its stated error") {
  std::mt19937_64 engine(3);
  std::uniform_real_distribution<double> exponent(-1000.0, 1000.0);
  double worst = 0.0;
  for (int i = 0; i < 200'000; ++i) {
    const double x = std::exp2(exponent(engine));
    worst = std::max(worst, error_ulp(core::inverse_cube_root(x), 1.0L / std::cbrt(static_cast<long double>(x))));
  }
  INFO("largest error " << worst << " ulp");
  CHECK(worst <= core::inverse_cube_root_max_error_ulp);
  CHECK(core::inverse_cube_root(27.0) == Approx(1.0 / 3.0).epsilon(1e-15));
}
