#include "app/stop_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/continuation.hpp"
#include "core/error.hpp"
#include "results/schema/text.hpp"
#include "studies/study/unmet_cells.hpp"

namespace ridgeloc::app {

namespace {

constexpr std::size_t most_named = 3;

std::string shortfall_text(const studies::Precision& precision) {
  if (!std::isfinite(precision.error_over_target)) return "error unknown";
  if (precision.error_over_target <= 1.0) return "error not reliable";
  return fmt::format("{:.3g} times the target", precision.error_over_target);
}

}  // namespace

std::string target_text(const studies::StopRule& rule) {
  return fmt::format("standard error of the {} of {} at most {}", rule.statistic, rule.metric,
                     rule.is_relative ? fmt::format("{:.6g} %", 100.0 * rule.target) : fmt::format("{}", rule.target));
}

std::string reached_text(const studies::StopRule& rule, const results::Summary& summary) {
  const auto unmet = studies::unmet_cells(rule, summary);
  if (unmet.empty()) return fmt::format("all cells have reached the target ({})", target_text(rule));
  std::string text = fmt::format("{} of {} {} not reached the target ({})", unmet.size(),
                                 results::count_text(summary.header.cells.size(), "cell"),
                                 unmet.size() == 1 ? "has" : "have", target_text(rule));
  for (std::size_t i = 0; i < std::min(unmet.size(), most_named); ++i) {
    const std::string name = results::cell_text(summary.header, unmet[i].cell);
    text += fmt::format("{} {}{}{} after {} trials", i == 0 ? ":" : ";", name, name.empty() ? "" : ": ",
                        shortfall_text(unmet[i].precision), unmet[i].trials);
  }
  if (unmet.size() > most_named) text += fmt::format("; and {} more", unmet.size() - most_named);
  return text;
}

std::string reached_text(const results::Summary& summary, const std::string& path) {
  try {
    const studies::Study study = study_of(summary.header, path);
    return study.stop ? reached_text(*study.stop, summary) : "";
  } catch (const core::InputError&) {
    return "";
  }
}

}  // namespace ridgeloc::app
