#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "solvers/options.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

/// The section [solver]: one setting for each of `solvers::SolverOptions`.
std::vector<Setting> solver_settings();

/// The names of all solvers.
std::vector<std::string> solver_names();

/// The settings that a solver reads: those that all of them read, and `solvers::SolverEntry::options`.
std::vector<std::string> settings_read_by(std::string_view solver);

/// What a method's own settings, and where it has none the cell's, say about its solver; for settings that the
/// experiment does not have the default.
solvers::SolverOptions solver_options(const Values& cell, const Values& given);

}  // namespace ridgeloc::studies
