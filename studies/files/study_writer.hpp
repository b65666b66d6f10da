#pragma once

#include <string>

#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// The study as a study file with nothing left to a default: what a result carries, and what runs again as it is.
std::string resolved_toml(const Study& study);

/// A commented study file to start from, made from the experiment's settings.
std::string template_toml(const Experiment& experiment);

}  // namespace ridgeloc::studies
