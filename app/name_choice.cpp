#include "app/name_choice.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/excerpt.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::app {

void check_name(const char* option, const std::string& name, const std::vector<std::string>& allowed) {
  if (std::ranges::find(allowed, name) != allowed.end()) return;
  const std::string nearest = studies::nearest_name(name, allowed);
  throw core::InputError(fmt::format("{} \"{}\" is unknown{} (allowed: {})", option, core::excerpt(name),
                                     nearest.empty() ? "" : fmt::format(", did you mean \"{}\"?", nearest),
                                     fmt::join(allowed, ", ")));
}

}  // namespace ridgeloc::app
