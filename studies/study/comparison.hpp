#pragma once

#include <algorithm>
#include <optional>
#include <string>

#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// How results call a comparison: "rrr - rr".
inline std::string label_of(const Comparison& comparison) {
  return comparison[0] + " - " + comparison[1];
}

/// How figures call the ratio of the two: "rrr / rr".
inline std::string ratio_label_of(const Comparison& comparison) {
  return comparison[0] + " / " + comparison[1];
}

/// A comparison that is called like one of the methods, if there is one: in a result both would have one name.
inline std::optional<Comparison> named_like_a_method(const Study& study) {
  for (const Comparison& comparison : study.comparisons) {
    const bool taken = std::ranges::find(study.methods, label_of(comparison), &Method::label) != study.methods.end();
    if (taken) return comparison;
  }
  return std::nullopt;
}

}  // namespace ridgeloc::studies
