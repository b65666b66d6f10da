#include "studies/value.hpp"

#include "catch.hpp"

using namespace ridgeloc::studies;

TEST_CASE("values are written so that they read back, reals never as whole numbers") {
  CHECK(to_toml(Value(std::int64_t{5})) == "5");
  CHECK(to_toml(Value(5.0)) == "5.0");
  CHECK(to_toml(Value(0.1)) == "0.1");
  CHECK(to_toml(Value(1e-20)) == "1e-20");
  CHECK(to_toml(Value(Interval{-60, 0.5})) == "[-60.0, 0.5]");
  CHECK(to_toml(Value(std::string("a \"b\" \\ \n"))) == "\"a \\\"b\\\" \\\\ \\u000A\"");
}

TEST_CASE("the nearest name is found, and none where none is near") {
  const std::vector<std::string> names = {"points", "depth_m", "depth_distribution"};
  CHECK(nearest_name("pionts", names) == "points");
  CHECK(nearest_name("depthm", names) == "depth_m");
  CHECK(nearest_name("zzzzzzzz", names).empty());
  CHECK(nearest_name("x", {}).empty());
}
