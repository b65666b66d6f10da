#include "app/duration.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <regex>

#include "core/error.hpp"
#include "core/excerpt.hpp"

namespace ridgeloc::app {

std::string duration_text(double seconds) {
  if (seconds < 10.0) return fmt::format("{:.2f} s", seconds);
  if (seconds < 59.5) return fmt::format("{:.0f} s", seconds);
  // More is days, whose number may be larger than integers are.
  const auto whole = static_cast<std::uint64_t>(std::llround(std::min(seconds, 1e9)));
  if (whole < 3600) return fmt::format("{} min {} s", whole / 60, whole % 60);
  if (whole < 48 * 3600) return fmt::format("{} h {} min", whole / 3600, whole % 3600 / 60);
  const double days = seconds / 86400.0;
  constexpr double days_per_year = 365.25;
  return days < 2.0 * days_per_year ? fmt::format("{:.1f} days", days)
                                    : fmt::format("{:.0f} years", days / days_per_year);
}

namespace {

/// Seconds of numbers with units, or of one number without; 0 if it is none.
double seconds_with_units(const std::string& text) {
  static const std::regex number("([0-9]+)([smhd]?)");
  if (!std::regex_match(text, std::regex("[0-9]+|([0-9]+[smhd])+"))) return 0.0;
  double seconds = 0.0;
  for (std::sregex_iterator part(text.begin(), text.end(), number), end; part != end; ++part) {
    const std::string unit = (*part)[2];
    const double factor = unit == "m" ? 60.0 : unit == "h" ? 3600.0 : unit == "d" ? 86400.0 : 1.0;
    seconds += factor * std::stod((*part)[1]);
  }
  return seconds;
}

/// Seconds of [D-][HH:]MM:SS; 0 if it is no such text.
double seconds_with_colons(const std::string& text) {
  std::smatch part;
  if (!std::regex_match(text, part, std::regex("(?:([0-9]+)-)?(?:([0-9]+):)?([0-9]+):([0-9]+)"))) return 0.0;
  const auto number = [&](std::size_t i) { return part[i].matched ? std::stod(part[i]) : 0.0; };
  return ((number(1) * 24.0 + number(2)) * 60.0 + number(3)) * 60.0 + number(4);
}

}  // namespace

std::string rate_text(double trials_per_second) {
  if (trials_per_second >= 1e6) return fmt::format("{:.2f} M trials/s", trials_per_second / 1e6);
  if (trials_per_second >= 1e3) return fmt::format("{:.1f} k trials/s", trials_per_second / 1e3);
  return fmt::format("{:.3g} trials/s", trials_per_second);
}

double seconds_of(const std::string& text) {
  constexpr double longest = 1e9;
  // Regular expressions of the standard library recurse for each character of what they match.
  constexpr std::size_t most_characters = 40;
  const bool is_short = text.size() <= most_characters;
  const double seconds = is_short ? std::max(seconds_with_units(text), seconds_with_colons(text)) : 0.0;
  if (!(seconds > 0.0 && seconds <= longest)) {
    throw core::InputError(
        fmt::format("\"{}\" is not a time; write it as 90s, 10m, 1h30m or HH:MM:SS, above zero", core::excerpt(text)));
  }
  return seconds;
}

}  // namespace ridgeloc::app
