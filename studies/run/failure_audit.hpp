#pragma once

#include <cstdint>
#include <vector>

#include "results/blocks/ledger.hpp"
#include "studies/plan/plan.hpp"
#include "studies/run/work_queue.hpp"
#include "studies/study/capabilities.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// Solves the trials of a ledger again, of every cell those below `trials`, and gives each that a method failed on to
/// the reference: counts by cell and method (cell * methods + method). Writes nothing; the same for any queue. Throws
/// core::InputError where the experiment has no recount of failures. Preconditions: the ledger is of a result of the
/// plan; core::is_supported(plan.isa).
std::vector<FailureCounts> audit_failures(const Study& study, const Plan& plan, const results::Ledger& ledger,
                                          std::uint64_t trials, WorkQueue& queue);

}  // namespace ridgeloc::studies
