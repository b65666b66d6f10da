#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solvers/options.hpp"
#include "studies/value.hpp"

namespace ridgeloc::studies {

/// The section [solver]: one setting for each of `solvers::SolverOptions`.
std::vector<Setting> solver_settings();

/// Those that every solver reads; `solvers::SolverEntry::options` names the others.
const std::vector<std::string>& common_solver_settings();

/// What a method's own settings, and where it has none the cell's, say about its solver; for settings that the
/// experiment does not have the default.
solvers::SolverOptions solver_options(const Values& cell, const Values& given);

}  // namespace ridgeloc::studies
