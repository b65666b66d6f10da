#pragma once

#include <string>
#include <vector>

#include "studies/files/study_reader.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

namespace ridgeloc::tests {

/// A study that can be read.
inline const std::string valid = R"(experiment = "ranging"
trials = 10
[scene]
depth_m = [2, 8]
[sweep]
points = [3, 5]
[[method]]
solver = "rr"
k = "fixed"
k_fixed = 0.5
)";

inline studies::Study read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return studies::read_study({"demo", "demo.toml", text}, overrides);
}

/// The error message of a study, empty if there is none.
inline std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return refusal_of([&] { studies::make_plan(read(text, overrides)); });
}

/// `valid` with one piece replaced.
inline std::string with(const std::string& piece, const std::string& replacement) {
  std::string text = valid;
  const auto at = text.find(piece);
  REQUIRE(at != std::string::npos);
  return text.replace(at, piece.size(), replacement);
}

}  // namespace ridgeloc::tests
