#pragma once

#include <cstdint>
#include <vector>

#include "studies/plan.hpp"
#include "studies/study.hpp"

namespace ridgeloc::studies {

/// Solves the first `trials` trials of every cell again, on `threads` threads, and gives each that a method failed on
/// to the reference: counts by cell and method (cell * methods + method). Writes nothing; the same for any number of
/// threads. Precondition: core::is_supported(plan.isa).
std::vector<FailureCounts> audit_failures(const Study& study, const Plan& plan, std::uint64_t trials, int threads);

}  // namespace ridgeloc::studies
