#include "results/report/html.hpp"

#include <fmt/format.h>

#include <cmath>

namespace ridgeloc::results {

std::string html_text(std::string_view text) {
  std::string html;
  html.reserve(text.size());
  for (const char c : text) {
    switch (c) {
      case '&':
        html += "&amp;";
        break;
      case '<':
        html += "&lt;";
        break;
      case '>':
        html += "&gt;";
        break;
      case '"':
        html += "&quot;";
        break;
      case '\n':
      case '\t':
        html += c;
        break;
      default:
        html += static_cast<unsigned char>(c) < 0x20 || c == 0x7f ? ' ' : c;
    }
  }
  return html;
}

std::string html_heading(int level, std::string_view id, std::string_view text) {
  return fmt::format("<h{0} id=\"{1}\">{2}</h{0}>\n", level, html_text(id), html_text(text));
}

std::string html_code(std::string_view text) {
  return fmt::format("<code>{}</code>", html_text(text));
}

std::string html_command(std::string_view command) {
  return fmt::format("<pre class=\"command\"><code>{}</code></pre>\n", html_text(command));
}

std::string html_details(std::string_view summary, bool open, std::string_view html) {
  return fmt::format("<details{}>\n<summary>{}</summary>\n{}</details>\n", open ? " open" : "", html_text(summary),
                     html);
}

HtmlCell text_cell(std::string_view text) {
  return {html_text(text)};
}

HtmlCell number_cell(double value) {
  return {std::isnan(value) ? "-" : fmt::format("{:.4g}", value)};
}

HtmlCell count_cell(std::uint64_t value) {
  return {fmt::format("{}", value)};
}

HtmlTable::HtmlTable(std::string caption, std::vector<Column> columns)
    : caption_(std::move(caption)), columns_(std::move(columns)) {}

void HtmlTable::add(const std::vector<HtmlCell>& cells) {
  if (++rows_ > most_rows) return;
  body_ += "<tr>";
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    const bool head = columns_[i].kind == Kind::Head;
    const HtmlCell& cell = cells[i];
    body_ += head ? "<th scope=\"row\"" : "<td";
    if (columns_[i].kind == Kind::Number) body_ += " class=\"n\"";
    if (!cell.sort_key.empty()) body_ += fmt::format(" data-key=\"{}\"", html_text(cell.sort_key));
    body_ += fmt::format(">{}</{}>", cell.html, head ? "th" : "td");
  }
  body_ += "</tr>\n";
}

std::string HtmlTable::html() const {
  std::string head;
  for (const Column& column : columns_) {
    head += fmt::format("<th scope=\"col\"{}>{}</th>", column.kind == Kind::Number ? " class=\"n\"" : "",
                        html_text(column.name));
  }
  const std::string cut = rows_ <= most_rows ? ""
                                             : fmt::format(
                                                   "<p class=\"note\">Only the first {} of {} rows are shown; "
                                                   "<code>ridgeloc export</code> writes all of them.</p>\n",
                                                   most_rows, rows_);
  // What scrolls must be within reach of the keyboard, and then have a name.
  return fmt::format(
      "<div class=\"scroll\" role=\"region\" tabindex=\"0\" "
      "aria-label=\"{0}\">\n<table>\n<caption><span>{0}</span></caption>\n"
      "<thead><tr>{1}</tr></thead>\n<tbody>\n{2}</tbody>\n</table>\n</div>\n{3}",
      html_text(caption_), head, body_, cut);
}

}  // namespace ridgeloc::results
