#pragma once

#include "results/store/provenance.hpp"

namespace ridgeloc::app {

/// What the program knows about its own build: version, commit, compiler, flags, versions of its libraries.
results::Provenance build_provenance();

}  // namespace ridgeloc::app
