#pragma once
// Internal to results: pieces of an HTML page. Arguments called `html` are put in as they are, all others as text.

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeloc::results {

/// Text as it stands in HTML, between tags and in attributes between double quotes. Control characters but for the
/// line feed and the tab become spaces.
std::string html_text(std::string_view text);

std::string html_heading(int level, std::string_view id, std::string_view text);
std::string html_code(std::string_view text);

/// A command to be copied.
std::string html_command(std::string_view command);

/// A part that is folded until asked for, or open to begin with.
std::string html_details(std::string_view summary, bool open, std::string_view html);

/// A cell of a table. Columns sort by the key where there is one, by the text where not.
struct HtmlCell {
  std::string html;
  std::string sort_key = {};
};
HtmlCell text_cell(std::string_view text);
/// Four significant digits, "-" for NaN.
HtmlCell number_cell(double value);
HtmlCell count_cell(std::uint64_t value);

/// A table that a script can sort and filter, in a box of its own that scrolls sideways where it is too wide.
class HtmlTable {
 public:
  enum class Kind { Head, Text, Number };  ///< of a column; `Head`: its cells say what the row is about
  struct Column {
    std::string name;
    Kind kind = Kind::Text;
  };

  /// Larger tables are cut off, and say so: a browser takes no pleasure in a million cells.
  static constexpr std::size_t most_rows = 5000;

  HtmlTable(std::string caption, std::vector<Column> columns);

  /// Precondition: as many cells as columns.
  void add(const std::vector<HtmlCell>& cells);
  std::size_t rows() const { return rows_; }
  std::string html() const;

 private:
  std::string caption_;
  std::vector<Column> columns_;
  std::string body_;
  std::size_t rows_ = 0;
};

}  // namespace ridgeloc::results
