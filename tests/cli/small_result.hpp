#pragma once

#include <sstream>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

namespace ridgeloc::tests {

inline std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// A folder with the result of a small study with two figures.
struct WithResult : WorkingFolder {
  WithResult() {
    write("study.toml", R"(title = "A small study"
experiment = "ranging"
trials = 40
[sweep]
points = [3, 5]
range_sigma_m = [0.1, 0.3]
[[method]]
solver = "rrr"
[[method]]
solver = "lm"
[[figure]]
x = "points"
y = "error_all_m"
group = ["method", "range_sigma_m"]
[[figure]]
name = "rate"
x = "points"
y = "converged"
group = "range_sigma_m"
facet = "method"
methods = ["rrr", "lm"]
)");
    REQUIRE(ridgeloc("run study.toml -o result.h5").exit_code == 0);
  }
};

}  // namespace ridgeloc::tests
