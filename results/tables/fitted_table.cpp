#include "results/tables/fitted_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "results/schema/text.hpp"

namespace ridgeloc::results {
namespace {

using Align = FittedTable::Align;

constexpr std::size_t widest_label = 40;
constexpr std::size_t gap = 2;  ///< before each column

/// Rows after which the names of the columns come again, with the next group.
constexpr std::size_t rows_per_head = 40;

/// Columns before the decimal point, or where a number without one ends.
std::size_t width_before_point(const std::string& text) {
  return display_width(text.substr(0, std::min(text.find_first_of(".e "), text.size())));
}

std::string spaces(std::size_t count) {
  return std::string(count, ' ');
}

/// A column whose texts are all equally wide.
struct Aligned {
  std::string name;
  std::string note;
  std::vector<std::string> entries;
  std::size_t width = 0;
};

Aligned aligned(const FittedTable::Column& column, std::vector<std::string> entries) {
  if (column.align == Align::Point) {
    std::size_t most = 0;
    for (const std::string& entry : entries) most = std::max(most, width_before_point(entry));
    for (std::string& entry : entries) entry = spaces(most - width_before_point(entry)) + entry;
  }
  Aligned out{column.name, column.note, std::move(entries), 0};
  std::vector<std::string*> texts = {&out.name, &out.note};
  for (std::string& entry : out.entries) texts.push_back(&entry);
  for (const std::string* text : texts) out.width = std::max(out.width, display_width(*text));
  for (std::string* text : texts) {
    const std::string padding = spaces(out.width - display_width(*text));
    *text = column.align == Align::Right ? padding + *text : *text + padding;
  }
  return out;
}

std::vector<std::string> labels_of(const FittedTable& table) {
  std::vector<std::string> labels;
  // A longer one has a line of its own.
  for (const FittedTable::Row& row : table.rows)
    labels.push_back(display_width(row.label) > widest_label ? "" : row.label);
  return labels;
}

std::vector<Aligned> key_columns(const FittedTable& table) {
  std::vector<Aligned> columns;
  for (std::size_t k = 0; k < table.keys.size(); ++k) {
    std::vector<std::string> entries;
    for (const FittedTable::Row& row : table.rows) entries.push_back(table.groups[row.group][k]);
    columns.push_back(aligned(table.keys[k], std::move(entries)));
  }
  return columns;
}

std::vector<Aligned> value_columns(const FittedTable& table) {
  std::vector<Aligned> columns;
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    std::vector<std::string> entries;
    for (const FittedTable::Row& row : table.rows) entries.push_back(row.entries[c]);
    columns.push_back(aligned(table.columns[c], std::move(entries)));
  }
  return columns;
}

std::size_t width_of(const std::vector<Aligned>& columns) {
  return std::accumulate(columns.begin(), columns.end(), std::size_t{0},
                         [](std::size_t sum, const Aligned& column) { return sum + gap + column.width; });
}

/// The columns that there is room for, at least one.
std::vector<std::size_t> fitting(const std::vector<Aligned>& columns, std::size_t room) {
  std::vector<std::size_t> chosen;
  std::size_t used = 0;
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::size_t width = gap + columns[c].width;
    if (used + width > room && !(chosen.empty() && c + 1 == columns.size())) continue;
    used += width;
    chosen.push_back(c);
  }
  return chosen;
}

std::string trimmed_line(std::string line) {
  line.erase(line.find_last_not_of(' ') + 1);
  return line.empty() ? line : line + "\n";
}

template <class Text>
std::string line_of(const std::vector<Aligned>& columns, Text&& text) {
  std::string line;
  for (const Aligned& column : columns) line += spaces(gap) + text(column);
  return trimmed_line(line);
}

std::string head_of(const std::vector<Aligned>& columns) {
  return line_of(columns, [](const Aligned& column) { return column.name; }) +
         line_of(columns, [](const Aligned& column) { return column.note; });
}

std::string group_line(const FittedTable& table, std::size_t group, std::size_t width) {
  std::vector<std::string> texts;
  for (std::size_t k = 0; k < table.keys.size(); ++k)
    texts.push_back(fmt::format("{} = {}", table.keys[k].name, table.groups[group][k]));
  return texts.empty() ? "" : wrapped_text(fmt::format("{}", fmt::join(texts, ", ")), width);
}

/// Whether any group has several rows.
bool has_large_groups(const FittedTable& table) {
  return std::ranges::adjacent_find(table.rows, {}, &FittedTable::Row::group) != table.rows.end();
}

std::string body(const FittedTable& table, const std::vector<Aligned>& columns, bool keys_above, std::size_t width) {
  const bool large_groups = has_large_groups(table);
  std::string text = head_of(columns);
  std::size_t since_head = 0;
  for (std::size_t r = 0; r < table.rows.size(); ++r) {
    const FittedTable::Row& row = table.rows[r];
    if (r == 0 || table.rows[r - 1].group != row.group) {
      if (since_head >= rows_per_head) {
        text += fmt::format("\n{}", head_of(columns));
        since_head = 0;
      } else if (r > 0 && large_groups) {
        text += "\n";
      }
      if (keys_above) text += group_line(table, row.group, width);
    }
    if (display_width(row.label) > widest_label) text += wrapped_text(spaces(gap) + row.label, width, 2 * gap);
    text += line_of(columns, [&](const Aligned& column) { return column.entries[r]; });
    ++since_head;
  }
  return text;
}

}  // namespace

FittedText fitted_text(const FittedTable& table, std::size_t width) {
  std::vector<Aligned> shown = key_columns(table);
  const Aligned labels = aligned({table.label, "", Align::Left}, labels_of(table));
  const std::vector<Aligned> values = value_columns(table);

  const std::size_t room = width - std::min(width, gap + labels.width);
  const std::size_t key_room = width_of(shown);
  std::vector<std::size_t> chosen = fitting(values, room - std::min(room, key_room));
  const std::vector<std::size_t> with_keys_above = fitting(values, room);
  const bool keys_above = key_room > room || with_keys_above.size() > chosen.size();
  if (keys_above) {
    shown.clear();
    chosen = with_keys_above;
  }
  shown.push_back(labels);
  FittedText fitted;
  for (std::size_t c = 0; c < values.size(); ++c) {
    if (std::ranges::find(chosen, c) != chosen.end()) {
      shown.push_back(values[c]);
    } else {
      fitted.left_out.push_back(table.columns[c].name);
    }
  }
  fitted.text = body(table, shown, keys_above, width);
  return fitted;
}

std::string wrapped_text(std::string_view text, std::size_t width, std::size_t indent) {
  std::string lines;
  std::string line(text.substr(0, std::min(text.find_first_not_of(' '), text.size())));
  bool has_word = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    if (has_word && display_width(line) + 1 + display_width(word) > width) {
      lines += line + "\n";
      line = spaces(indent);
      has_word = false;
    }
    if (has_word) line += " ";
    line += word;
    has_word = true;
  }
  return has_word ? lines + line + "\n" : lines;
}

}  // namespace ridgeloc::results
