#pragma once

#include <filesystem>
#include <string>

#include "studies/plan/plan.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::app {

/// "512 KiB", "1.5 MiB", "24 GiB".
std::string size_text(double bytes);

/// Bytes that are free on the disk of a folder for this user; infinite where that cannot be told.
double free_bytes(const std::filesystem::path& folder);

/// Refuses with core::InputError, before anything is computed, to run a study whose result has no room beside its name,
/// and warns where there is not as much again, which it takes until its parts are sealed. What is there of it already
/// counts. Tries one trial where the plan alone cannot tell.
void require_room(const studies::Study& study, const studies::Plan& plan, const std::filesystem::path& output);

}  // namespace ridgeloc::app
