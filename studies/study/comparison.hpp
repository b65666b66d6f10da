#pragma once

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

}  // namespace ridgeloc::studies
