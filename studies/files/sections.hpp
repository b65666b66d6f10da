#pragma once

// Internal to studies: the larger tables of a study file, each read by its own source file.

#include <toml++/toml.h>

#include <string>

#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// [sweep]: axes, zip and exclude.
void read_sweep(const toml::table& document, Study& study);

/// [[method]]. Needs the sweep: a setting that is swept cannot be given to a method too.
void read_methods(const toml::table& document, const std::string& origin, Study& study);

/// [[compare]], or each method against the first. Needs the methods.
void read_comparisons(const toml::table& document, Study& study);

/// [stop]. Needs the methods and comparisons.
void read_stop(const toml::table& document, Study& study);

/// [[figure]]. Needs sweep, methods and comparisons.
void read_figures(const toml::table& document, Study& study);

}  // namespace ridgeloc::studies
