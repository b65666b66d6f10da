#include "studies/files/csv_columns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "core/error.hpp"
#include "core/excerpt.hpp"
#include "studies/files/text_file.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

namespace {

/// A measurement of a hundred thousand rows with many columns.
constexpr std::size_t most_mib = 256;

/// What separates the cells of a CSV text: a comma, but where the first line has none, a semicolon or a tabulator.
/// Spreadsheets write these where the comma is the decimal point.
char separator_of(std::string_view text) {
  char found = ',';
  bool quoted = false;
  for (const char c : text.substr(0, text.find_first_of("\r\n"))) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == ',') return c;
    if (found == ',' && (c == ';' || c == '\t')) found = c;
  }
  return found;
}

/// The rows of a CSV text, one after the other.
class Rows {
 public:
  explicit Rows(std::string text) : text_(std::move(text)) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
    while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == '\r')) end_line();
    separator_ = separator_of(std::string_view(text_).substr(at_));
  }

  char separator() const { return separator_; }

  /// The cells of the next row that is not an empty line; none at the end.
  std::vector<std::string> next() {
    while (at_ < text_.size() && (text_[at_] == '\n' || text_[at_] == '\r')) end_line();
    first_line_ = line_;
    std::vector<std::string> cells;
    if (at_ == text_.size()) return cells;
    do cells.push_back(cell());
    while (take(separator_));
    end_line();
    return cells;
  }

  /// Where the row begins that `next` gave last; lines count from 1.
  std::size_t line() const { return first_line_; }

 private:
  bool take(char expected) {
    if (at_ == text_.size() || text_[at_] != expected) return false;
    ++at_;
    return true;
  }

  void end_line() {
    take('\r');
    if (take('\n')) ++line_;
  }

  /// One cell, without the blanks around it; a pair of quotes inside quotes is one quote.
  std::string cell() {
    while (at_ < text_.size() && is_blank(text_[at_])) ++at_;
    std::string out;
    if (take('"')) {
      while (at_ < text_.size()) {
        const char c = text_[at_++];
        if (c == '"' && !take('"')) break;
        if (c == '\n') ++line_;
        out += c;
      }
    }
    while (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n' && text_[at_] != '\r') {
      out += text_[at_++];
    }
    while (!out.empty() && is_blank(out.back())) out.pop_back();
    return out;
  }

  bool is_blank(char c) const { return c != separator_ && (c == ' ' || c == '\t'); }

  std::string text_;
  char separator_ = ',';
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t first_line_ = 1;
};

std::optional<double> number_in(std::string text, bool decimal_comma) {
  if (decimal_comma && std::ranges::count(text, ',') == 1 && text.find('.') == std::string::npos)
    text[text.find(',')] = '.';
  const char* begin = text.c_str() + (text.starts_with('+') ? 1 : 0);
  const char* const past = text.c_str() + text.size();
  double value = 0.0;
  const auto [end, failure] = std::from_chars(begin, past, value);
  const bool whole = failure == std::errc{} && end == past;
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

/// Where a column stands in the first line.
std::size_t position_of(const std::string& column, const std::vector<std::string>& names, const std::string& place) {
  const auto found = std::ranges::find(names, column);
  if (found != names.end()) return static_cast<std::size_t>(found - names.begin());
  const std::string nearest = core::excerpt(nearest_name(column, names));
  std::vector<std::string> shown;
  for (const std::string& name : names) shown.push_back(core::excerpt(name));
  throw core::InputError(fmt::format("{}: no column \"{}\"{}", place, core::excerpt(column),
                                     nearest.empty() ? fmt::format(" (there are: {})", fmt::join(shown, ", "))
                                                     : fmt::format(" (did you mean \"{}\"?)", nearest)));
}

}  // namespace

std::vector<std::vector<double>> read_csv_columns(const std::filesystem::path& path,
                                                  const std::vector<std::string>& columns, std::size_t most) {
  return columns_in(read_text_file(path, most_mib), path.string(), columns, most);
}

std::vector<std::vector<double>> columns_in(std::string text, const std::string& origin,
                                            const std::vector<std::string>& columns, std::size_t most) {
  Rows rows(std::move(text));
  const auto place = [&] { return fmt::format("{}:{}", origin, rows.line()); };

  const std::vector<std::string> names = rows.next();
  std::vector<std::size_t> positions;
  for (const std::string& column : columns) positions.push_back(position_of(column, names, place()));
  std::vector<std::vector<double>> values(columns.size());
  std::size_t read = 0;
  for (auto cells = rows.next(); !cells.empty() && read < most; cells = rows.next(), ++read) {
    if (cells.size() > names.size()) {
      throw core::InputError(fmt::format("{}: {} cells where the first line names {}; is a comma the decimal point?",
                                         place(), cells.size(), names.size()));
    }
    for (std::size_t c = 0; c < columns.size(); ++c) {
      const std::string cell = positions[c] < cells.size() ? cells[positions[c]] : std::string();
      const auto value = number_in(cell, rows.separator() != ',');
      if (!value)
        throw core::InputError(
            fmt::format("{}: \"{}\" in column \"{}\" is not a number", place(), core::excerpt(cell), columns[c]));
      values[c].push_back(*value);
    }
  }
  return values;
}

}  // namespace ridgeloc::studies
