#include "results/report/report_part.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "results/schema/text.hpp"

namespace ridgeloc::results {

std::string measure_id(std::size_t measure) {
  return fmt::format("measure{}", measure + 1);
}

std::string sentence(std::string text) {
  if (!text.empty() && text.front() >= 'a' && text.front() <= 'z')
    text.front() = static_cast<char>(text.front() - 'a' + 'A');
  return text.ends_with('.') ? text : text + ".";
}

std::vector<HtmlTable::Column> factor_columns(const Header& header) {
  std::vector<HtmlTable::Column> columns;
  for (const Axis& axis : header.axes)
    columns.push_back(
        {axis.unit == "1" ? axis.name : fmt::format("{} [{}]", axis.name, axis.unit), HtmlTable::Kind::Head});
  return columns;
}

std::vector<HtmlCell> factor_cells(const Header& header, std::size_t cell) {
  std::vector<HtmlCell> cells;
  for (std::size_t a = 0; a < header.axes.size(); ++a)
    cells.push_back(text_cell(factor_text(header.axes[a].values[header.cells[cell].indices[a]])));
  return cells;
}

}  // namespace ridgeloc::results
