#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/schema/schema.hpp"
#include "studies/plan/assignment.hpp"
#include "studies/plan/plan.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::app {

/// Throws core::InputError if shares of the study cannot be computed apart.
void require_shareable(const studies::Study& study);

/// Why the blocks of a result with the header `found` do not belong to a study, "holds another study (seed is 1, not
/// 2018)"; empty if they do.
std::string difference_to(const studies::Study& study, const results::Header& found, const std::string& path);

/// The study that a result says it is. Throws core::InputError if this program cannot read it: a solver or an estimator
/// of K may come from another one.
studies::Study study_of(const results::Header& header, const std::string& path);

/// A study to run, and what it amounts to together with all that its result holds already.
struct Job {
  studies::Study study;  ///< as asked for, widened by what the result has besides
  studies::Plan plan;
  studies::Assignment assignment;  ///< what was asked for
  std::filesystem::path output;
};

/// Plans a run that goes on from whatever is at `output`: a sealed result, parts of a stopped run, both or nothing.
/// `isa` is what the user asked for; empty: what the result was begun with, or else the widest that there is.
/// Throws core::InputError if the study cannot go on from there.
Job continued(studies::Study study, const std::filesystem::path& output, const std::string& isa,
              const studies::Shard& shard);

}  // namespace ridgeloc::app
