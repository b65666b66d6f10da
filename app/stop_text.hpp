#pragma once

#include <string>

#include "results/summary/summary.hpp"
#include "studies/study/stop_rule.hpp"

namespace ridgeloc::app {

/// "standard error of the mean of error_m at most 0.5 %".
std::string target_text(const studies::StopRule& rule);

/// Which cells of a result are not known as well as the rule asks for, in one line without an end: "2 of 6 cells have
/// not reached the target (...): ...", the first three of them by name; or that all have reached it.
std::string reached_text(const studies::StopRule& rule, const results::Summary& summary);

/// The same of a result by the rule of its study; empty where the study has none, or this program cannot read it.
std::string reached_text(const results::Summary& summary, const std::string& path);

}  // namespace ridgeloc::app
