#include "studies/files/decimal_range.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

namespace ridgeloc::studies {

namespace {

__extension__ using Wide = __int128;

/// digits * 10^exponent, the shortest that is read as this number.
struct Decimal {
  std::int64_t digits = 0;
  int exponent = 0;
};

Decimal decimal(double value) {
  std::array<char, 32> text{};
  const auto end = std::to_chars(text.data(), text.data() + text.size(), value, std::chars_format::scientific).ptr;
  const std::string_view whole(text.data(), static_cast<std::size_t>(end - text.data()));
  const std::size_t e = whole.find('e');
  Decimal out;
  // from_chars takes no plus sign.
  const std::string_view power = whole.substr(whole[e + 1] == '+' ? e + 2 : e + 1);
  std::from_chars(power.data(), power.data() + power.size(), out.exponent);
  bool after_point = false;
  for (const char c : whole.substr(0, e)) {
    if (c == '.') after_point = true;
    if (c < '0' || c > '9') continue;
    out.digits = 10 * out.digits + (c - '0');
    if (after_point) --out.exponent;
  }
  if (whole.front() == '-') out.digits = -out.digits;
  return out;
}

/// In units of 10^exponent, if that is no more than 30 digits.
std::optional<Wide> scaled(const Decimal& number, int exponent) {
  constexpr Wide largest = static_cast<Wide>(1'000'000'000'000'000) * 1'000'000'000'000'000;
  Wide value = number.digits;
  for (int e = number.exponent; e > exponent && value != 0; --e) {
    value *= 10;
    if (value > largest || value < -largest) return std::nullopt;
  }
  return value;
}

/// value * 10^exponent, rounded once.
double scaled_number(Wide value, int exponent) {
  std::array<char, 64> text{};
  char* at = text.data() + text.size();
  const auto put = [&](char c) { *--at = c; };
  const auto put_digits = [&](Wide rest) {
    do put(static_cast<char>('0' + static_cast<int>(rest % 10)));
    while ((rest /= 10) != 0);
  };
  put_digits(exponent < 0 ? -exponent : exponent);
  if (exponent < 0) put('-');
  put('e');
  put_digits(value < 0 ? -value : value);
  if (value < 0) put('-');
  double out = 0.0;
  std::from_chars(at, text.data() + text.size(), out);
  return out;
}

}  // namespace

DecimalRange decimal_range(double from, double to, double step, std::size_t most) {
  const std::array<Decimal, 3> given = {decimal(from), decimal(to), decimal(step)};
  int exponent = std::numeric_limits<int>::max();
  for (const Decimal& d : given)
    if (d.digits != 0) exponent = std::min(exponent, d.exponent);
  const auto first = scaled(given[0], exponent);
  const auto last = scaled(given[1], exponent);
  const auto by = scaled(given[2], exponent);
  DecimalRange range;
  if (!first || !last || !by || *by == 0) return range;
  const bool ahead = *last == *first || (*last < *first) == (*by < 0);
  Wide count = (*last - *first) / *by;
  if (!ahead || count >= static_cast<Wide>(most)) return range;
  const auto at = [&](Wide i) { return scaled_number(*first + i * *by, exponent); };
  // Numbers of 17 digits are written as something near them: what is read as `to` is `to`.
  if (at(count) != to && at(count + 1) == to) ++count;
  for (Wide i = 0; i <= count; ++i) range.values.push_back(at(i));
  range.reaches_end = range.values.back() == to;
  range.beyond = at(count + 1);
  return range;
}

}  // namespace ridgeloc::studies
