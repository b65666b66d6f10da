#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ridgeloc::results {

/// A table of texts in groups of rows, for a terminal: what a group is, the label of a row, and its entries.
struct FittedTable {
  enum class Align { Left, Right, Point };  ///< Point: the decimal points stand below each other
  struct Column {
    std::string name;
    std::string note;  ///< below the name; may be empty
    Align align = Align::Left;
  };
  struct Row {
    std::size_t group = 0;
    std::string label;
    std::vector<std::string> entries;  ///< one per column
  };

  std::vector<Column> keys;                      ///< what tells groups apart
  std::vector<std::vector<std::string>> groups;  ///< a text per key
  std::string label;                             ///< name of the labels
  std::vector<Column> columns;                   ///< what matters most first
  std::vector<Row> rows;                         ///< of a group next to each other
};

struct FittedText {
  std::string text;
  std::vector<std::string> left_out;  ///< names of the columns that had no room
};

/// The table within `width` columns of a terminal, and without its less important columns where they do not fit. The
/// keys are columns of their own, or a line above each group where there is more room for the others then; a label
/// that is too long for its column has a line of its own. The names of the columns come again in long tables.
FittedText fitted_text(const FittedTable& table, std::size_t width);

/// A text in lines of at most `width` columns, the later ones indented; longer words have lines of their own.
std::string wrapped_text(std::string_view text, std::size_t width, std::size_t indent = 2);

}  // namespace ridgeloc::results
