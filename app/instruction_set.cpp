#include "app/instruction_set.hpp"

#include <fmt/format.h>

#include "core/error.hpp"

namespace ridgeloc::app {

core::Isa instruction_set(const std::string& name) {
  if (name.empty()) return core::best_isa();
  const auto isa = core::find_isa(name);
  if (!isa || !core::is_supported(*isa)) {
    throw core::InputError(fmt::format("{} cannot compute with the instruction set {}; it can with {}",
                                       isa && !core::has_kernels(*isa) ? "this build" : "this processor", name,
                                       core::name_of(core::best_isa())));
  }
  return *isa;
}

}  // namespace ridgeloc::app
