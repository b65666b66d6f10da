#include "results/schema/text.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace ridgeloc::results {
namespace {

/// Numbers of this size and above, or with more decimals, are written with an exponent.
constexpr double largest_plain = 1e7;
constexpr int most_decimals = 6;

/// Decimals that show two significant digits of `error`.
int decimals_for(double error) {
  // The error is rounded first: 0.0996 is shown as 0.10, not as 0.100.
  const double rounded = std::strtod(fmt::format("{:.1e}", error).c_str(), nullptr);
  return std::max(0, 1 - static_cast<int>(std::floor(std::log10(rounded))));
}

bool is_plain(double value, int decimals) {
  return std::abs(value) < largest_plain && decimals <= most_decimals;
}

/// An error below the rounding of the value says that there is none.
bool is_exact(double value, double error) {
  return error <= std::abs(value) * std::numeric_limits<double>::epsilon();
}

int common_exponent(double value, double error) {
  return static_cast<int>(std::floor(std::log10(std::max(std::abs(value), error))));
}

}  // namespace

std::string factor_text(const FactorValue& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return *text;
  if (const auto* integer = std::get_if<std::int64_t>(&value)) return fmt::format("{}", *integer);
  return exact_text(std::get<double>(value));
}

std::string exact_text(double value) {
  if (std::isnan(value)) return "nan";  // a NaN may carry a sign, which says nothing
  return fmt::format("{}", value);
}

std::string count_text(std::uint64_t count, std::string_view what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

double decimal_number(double digit, int power) {
  return std::strtod(fmt::format("{}e{}", digit, power).c_str(), nullptr);
}

std::string cell_text(const Header& header, std::size_t cell) {
  std::string text;
  for (std::size_t axis = 0; axis < header.axes.size(); ++axis) {
    const FactorValue& value = header.axes[axis].values[header.cells[cell].indices[axis]];
    text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", header.axes[axis].name, factor_text(value));
  }
  return text;
}

std::string text_with_error(double value, double error) {
  if (std::isnan(value)) return "-";
  if (std::isnan(error)) return fmt::format("{:.4g} ± ?", value);
  if (is_exact(value, error) || !std::isfinite(error) || !std::isfinite(value)) {
    return fmt::format("{:.6g} ± {:.2g}", value, is_exact(value, error) ? 0.0 : error);
  }
  const int decimals = decimals_for(error);
  if (is_plain(value, decimals)) return fmt::format("{:.{}f} ± {:.{}f}", value, decimals, error, decimals);
  const int exponent = common_exponent(value, error);
  const double scale = std::pow(10.0, -exponent);
  const int scaled_decimals = decimals_for(error * scale);
  return fmt::format("({:.{}f} ± {:.{}f})e{:+03}", value * scale, scaled_decimals, error * scale, scaled_decimals,
                     exponent);
}

std::string text_with_digits(double value, double error) {
  if (std::isnan(value)) return "-";
  if (!std::isfinite(value) || is_exact(value, error)) return fmt::format("{:.6g}", value);
  if (!std::isfinite(error)) return fmt::format("{:.4g}({})", value, std::isnan(error) ? "?" : "inf");
  const auto digits = [](double v, double e) {
    const int decimals = decimals_for(e);
    return fmt::format("{:.{}f}({:.0f})", v, decimals, e * std::pow(10.0, decimals));
  };
  if (is_plain(value, decimals_for(error))) return digits(value, error);
  const int exponent = common_exponent(value, error);
  const double scale = std::pow(10.0, -exponent);
  return fmt::format("{}e{:+03}", digits(value * scale, error * scale), exponent);
}

std::string text_with_interval(double value, double lo, double hi) {
  if (std::isnan(value)) return "-";
  if (std::isnan(lo) || std::isnan(hi)) return fmt::format("{:.4g} [?]", value);
  const double half = (hi - lo) / 2.0;
  if (half > 0.0 && std::isfinite(half) && std::isfinite(value)) {
    const int decimals = decimals_for(half);
    if (is_plain(std::max({std::abs(value), std::abs(lo), std::abs(hi)}), decimals)) {
      return fmt::format("{:.{}f} [{:.{}f}, {:.{}f}]", value, decimals, lo, decimals, hi, decimals);
    }
  }
  return fmt::format("{:.4g} [{:.4g}, {:.4g}]", value, lo, hi);
}

std::size_t display_width(std::string_view text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U;  // continuation bytes take no column
  }));
}

}  // namespace ridgeloc::results
