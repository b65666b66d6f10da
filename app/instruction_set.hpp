#pragma once

#include <string>

#include "core/isa.hpp"

namespace ridgeloc::app {

/// The instruction set of that name, or without one the widest that this processor has.
/// Throws core::InputError where the processor or the program lacks it.
core::Isa instruction_set(const std::string& name);

}  // namespace ridgeloc::app
