#pragma once

#include <string>

#include "results/schema/schema.hpp"
#include "studies/plan/plan.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::app {

/// A result, ready for any of its trials to be computed again, bit for bit.
struct Recomputation {
  results::Header header;  ///< as the file has it
  studies::Study study;
  studies::Plan plan;  ///< with the instruction set of the result
};

/// Opens a result to recompute it. Throws core::InputError if it cannot be read, if this processor lacks the
/// instruction set that it was computed with, or if the experiment has changed its numbers since.
Recomputation recomputation_of(const std::string& result);

}  // namespace ridgeloc::app
