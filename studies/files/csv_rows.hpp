#pragma once

#include <cstddef>
#include <iosfwd>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeloc::studies {

/// The rows of a CSV text, read one after the other from a stream, which may be a pipe. Quotes stand where a cell needs
/// them, a pair of quotes inside quotes is one quote, blanks around a cell do not count, and empty lines are skipped.
/// Cells are separated by commas, or, where the first line has none, by semicolons or tabulators.
class CsvRows {
 public:
  explicit CsvRows(std::istream& text) : text_(text) {}

  /// The cells of the next row, or false at the end.
  bool next(std::vector<std::string>& cells);

  /// Where the row begins that `next` gave last; lines count from 1.
  std::size_t line() const { return first_line_; }

  /// Whether a quote of the row that `next` gave last is not closed, by the end or within a MiB.
  bool is_unclosed() const { return is_unclosed_; }

  /// A number as such rows have it: finite, with a decimal comma where commas do not separate. Nothing for other texts.
  std::optional<double> number_in(std::string_view cell) const;

 private:
  bool take_line();
  bool take(char expected);
  void read_cell(std::string& cell);
  bool is_blank(char c) const { return c != separator_ && (c == ' ' || c == '\t'); }

  std::istream& text_;
  std::string row_;  ///< one line, or several where quotes go on
  std::size_t at_ = 0;
  char separator_ = '\0';  ///< none yet
  std::size_t line_ = 0;
  std::size_t first_line_ = 1;
  bool is_unclosed_ = false;
};

}  // namespace ridgeloc::studies
