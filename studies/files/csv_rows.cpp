#include "studies/files/csv_rows.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <istream>

namespace ridgeloc::studies {

namespace {

/// Quotes that go on longer were never meant to.
constexpr std::size_t most_of_a_row = std::size_t{1} << 20;

/// What separates the cells of a CSV text that begins with this line: a comma, but where it has none, a semicolon or a
/// tabulator. Spreadsheets write these where the comma is the decimal point.
char separator_of(std::string_view line) {
  char found = ',';
  bool quoted = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == ',') return c;
    if (found == ',' && (c == ';' || c == '\t')) found = c;
  }
  return found;
}

}  // namespace

bool CsvRows::next(std::vector<std::string>& cells) {
  do {
    row_.clear();
    at_ = 0;
    first_line_ = line_ + 1;
    if (!take_line()) {
      cells.clear();
      return false;
    }
  } while (row_.empty());
  if (separator_ == '\0') separator_ = separator_of(row_);
  is_unclosed_ = false;
  std::size_t count = 0;
  do {
    if (count == cells.size()) cells.emplace_back();
    read_cell(cells[count++]);
  } while (take(separator_));
  cells.resize(count);
  return true;
}

/// Adds the next line to the row, without its end.
bool CsvRows::take_line() {
  std::string line;
  std::string& target = row_.empty() ? row_ : line;
  if (!std::getline(text_, target)) return false;
  ++line_;
  if (target.ends_with('\r')) target.pop_back();
  constexpr std::string_view byte_order_mark = "\xef\xbb\xbf";
  if (line_ == 1 && target.starts_with(byte_order_mark)) target.erase(0, byte_order_mark.size());
  if (&target == &line) row_ += line;
  return true;
}

bool CsvRows::take(char expected) {
  if (at_ == row_.size() || row_[at_] != expected) return false;
  ++at_;
  return true;
}

void CsvRows::read_cell(std::string& cell) {
  cell.clear();
  while (at_ < row_.size() && is_blank(row_[at_])) ++at_;
  if (take('"')) {
    for (;;) {
      if (at_ == row_.size()) {
        row_ += '\n';
        is_unclosed_ = row_.size() > most_of_a_row || !take_line();
        if (is_unclosed_) break;
      }
      const char c = row_[at_++];
      if (c == '"' && !take('"')) break;
      cell += c;
    }
  }
  while (at_ < row_.size() && row_[at_] != separator_) cell += row_[at_++];
  while (!cell.empty() && is_blank(cell.back())) cell.pop_back();
}

std::optional<double> CsvRows::number_in(std::string_view cell) const {
  std::string with_point;
  if (separator_ != ',' && std::ranges::count(cell, ',') == 1 && cell.find('.') == std::string_view::npos) {
    with_point = cell;
    with_point[with_point.find(',')] = '.';
    cell = with_point;
  }
  if (cell.starts_with('+')) cell.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  const bool whole = failure == std::errc{} && end == cell.data() + cell.size();
  return whole && std::isfinite(value) ? std::optional(value) : std::nullopt;
}

}  // namespace ridgeloc::studies
