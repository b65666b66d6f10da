#pragma once
// Internal to results: what report.css and report.js hold, compiled in.

#include <string_view>

namespace ridgeloc::results {

std::string_view report_style();
std::string_view report_script();

}  // namespace ridgeloc::results
