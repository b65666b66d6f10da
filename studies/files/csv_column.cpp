#include "studies/files/csv_column.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <sstream>
#include <string_view>

#include "core/error.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

namespace {

/// The rows of a CSV text, one after the other. Where the first line has semicolons and no comma, semicolons separate
/// the cells, as spreadsheets write them where the comma is the decimal point.
class Rows {
 public:
  explicit Rows(std::string text) : text_(std::move(text)) {
    constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
    if (text_.starts_with(byte_order_mark)) at_ = byte_order_mark.size();
    const std::string_view first = std::string_view(text_).substr(0, text_.find('\n'));
    if (first.find(',') == std::string_view::npos && first.find(';') != std::string_view::npos) separator_ = ';';
  }

  bool has_decimal_commas() const { return separator_ == ';'; }

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
    while (take(' ') || take('\t')) continue;
    std::string out;
    if (take('"')) {
      while (at_ < text_.size()) {
        const char c = text_[at_++];
        if (c == '"' && !take('"')) break;
        if (c == '\n') ++line_;
        out += c;
      }
    }
    while (at_ < text_.size() && text_[at_] != separator_ && text_[at_] != '\n' && text_[at_] != '\r')
      out += text_[at_++];
    while (!out.empty() && (out.back() == ' ' || out.back() == '\t')) out.pop_back();
    return out;
  }

  std::string text_;
  char separator_ = ',';
  std::size_t at_ = 0;
  std::size_t line_ = 1;
  std::size_t first_line_ = 1;
};

std::optional<double> number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  const bool whole = failure == std::errc{} && end == text.data() + text.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace

std::vector<double> read_csv_column(const std::filesystem::path& path, const std::string& column, std::size_t most) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  if (!file) throw core::InputError(fmt::format("{}: cannot be read; check its permissions", path.string()));
  Rows rows(std::move(text).str());

  const std::vector<std::string> names = rows.next();
  const auto found = std::ranges::find(names, column);
  if (found == names.end()) {
    const std::string nearest = nearest_name(column, names);
    throw core::InputError(fmt::format("{}:{}: no column \"{}\"{}", path.string(), rows.line(), column,
                                       nearest.empty() ? fmt::format(" (there are: {})", fmt::join(names, ", "))
                                                       : fmt::format(" (did you mean \"{}\"?)", nearest)));
  }
  const auto position = static_cast<std::size_t>(found - names.begin());
  std::vector<double> values;
  for (auto cells = rows.next(); !cells.empty() && values.size() < most; cells = rows.next()) {
    if (cells.size() > names.size()) {
      throw core::InputError(fmt::format("{}:{}: {} cells where the first line names {}; is a comma the decimal point?",
                                         path.string(), rows.line(), cells.size(), names.size()));
    }
    const std::string cell = position < cells.size() ? cells[position] : std::string();
    std::string point = cell;
    if (rows.has_decimal_commas()) std::ranges::replace(point, ',', '.');
    const auto value = number(point);
    if (!value) {
      throw core::InputError(
          fmt::format("{}:{}: \"{}\" in column \"{}\" is not a number", path.string(), rows.line(), cell, column));
    }
    values.push_back(*value);
  }
  return values;
}

}  // namespace ridgeloc::studies
