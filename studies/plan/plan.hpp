#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "core/isa.hpp"
#include "results/schema/schema.hpp"
#include "studies/plan/cell_grid.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// What a study amounts to: its cells, each cut into blocks, and what the result will say of itself.
struct Plan {
  CellGrid cells;
  core::Isa isa = core::Isa::Baseline;  ///< what the blocks are computed with
  results::Header header;
  std::vector<std::string> remarks;  ///< what is worth a word about the settings, each said once
};

/// Lays a study out. Throws core::InputError when `exclude` leaves no cell, where there are more than `max_cells`
/// or `max_totals`, and where the settings of a cell cannot stand together.
Plan make_plan(const Study& study, core::Isa isa = core::Isa::Baseline);

/// The lines "key = value" that the study hash is made of: what changes every number and is neither swept nor a
/// method's own. Trials, sweep values, methods, figures and titles are not part of it, so that a longer or wider study
/// continues an old result.
std::vector<std::string> study_content(const Study& study);

/// The hash of a method's solver with the settings that it reads, swept ones aside.
std::string method_hash(const Study& study, const Method& method);

/// Bytes of per-trial columns that one trial takes, over all methods.
std::uint64_t bytes_per_trial(const Study& study);

}  // namespace ridgeloc::studies
