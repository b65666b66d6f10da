#include "studies/study/value.hpp"

#include <cmath>

#include "tests/support/catch.hpp"

using namespace ridgeloc::studies;

TEST_CASE("values are written so that they read back, reals never as whole numbers") {
  CHECK(to_toml(Value(std::int64_t{5})) == "5");
  CHECK(to_toml(Value(5.0)) == "5.0");
  CHECK(to_toml(Value(0.1)) == "0.1");
  CHECK(to_toml(Value(1e-20)) == "1e-20");
  CHECK(to_toml(Value(Interval{-60, 0.5})) == "[-60.0, 0.5]");
  CHECK(to_toml(Value(std::string("a \"b\" \\ \n"))) == "\"a \\\"b\\\" \\\\ \\u000A\"");
}

TEST_CASE("samples are written as a list, know their root mean square, and are equal if their numbers are") {
  const Samples samples({1.0, -7.0, 0.5});
  CHECK(to_toml(Value(samples)) == "[1.0, -7.0, 0.5]");
  CHECK(samples.rms() == Approx(std::sqrt(50.25 / 3.0)).epsilon(1e-15));
  CHECK(to_toml(Value(Samples())) == "[]");
  CHECK(Samples().values().empty());
  CHECK(Samples().rms() == 0.0);
  CHECK(samples == Samples({1.0, -7.0, 0.5}));
  CHECK_FALSE(samples == Samples({1.0, -7.0}));
  CHECK(Samples() == Samples(std::vector<double>{}));
}

TEST_CASE("the nearest name is found, and none where none is near") {
  const std::vector<std::string> names = {"points", "depth_m", "depth_distribution"};
  CHECK(nearest_name("pionts", names) == "points");
  CHECK(nearest_name("depthm", names) == "depth_m");
  CHECK(nearest_name("zzzzzzzz", names).empty());
  CHECK(nearest_name("x", {}).empty());
}
