#include "results/pictures/page.hpp"

#include <algorithm>

#include "results/schema/text.hpp"

namespace ridgeloc::results {

LegendGrid legend_grid(const std::vector<std::string>& texts, double y, double page_width) {
  if (texts.empty()) return {{}, y};
  std::size_t longest = 0;
  for (const std::string& text : texts) longest = std::max(longest, display_width(text));
  const double entry =
      PageStyle::sample_length + PageStyle::sample_gap + static_cast<double>(longest) * small_character + 2.5;
  const double room = page_width - 2.0 * PageStyle::edge;
  const std::size_t fitting = std::max<std::size_t>(1, static_cast<std::size_t>(room / entry));
  const std::size_t rows = (texts.size() + fitting - 1) / fitting;
  const std::size_t columns = (texts.size() + rows - 1) / rows;
  const double used = std::min(room, static_cast<double>(columns) * entry);
  const double first = (page_width - used) / 2.0;
  LegendGrid grid;
  for (std::size_t i = 0; i < texts.size(); ++i) {
    grid.places.push_back({first + static_cast<double>(i % columns) * entry,
                           y + static_cast<double>(i / columns) * PageStyle::line_height});
  }
  grid.end = y + static_cast<double>(rows) * PageStyle::line_height;
  return grid;
}

std::size_t characters(double millimetres, double character) {
  return static_cast<std::size_t>(millimetres / character);
}

std::vector<std::string> wrapped(std::string_view text, std::size_t most) {
  std::vector<std::string> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string word(text.substr(0, end));
    text.remove_prefix(std::min(end + 1, text.size()));
    if (word.empty()) continue;
    if (lines.empty() || display_width(lines.back()) + 1 + display_width(word) > most) {
      lines.push_back(word);
    } else {
      lines.back() += " " + word;
    }
  }
  return lines;
}

namespace {

/// How many bytes the first `count` characters of a text take.
std::size_t bytes_of(std::string_view text, std::size_t count) {
  std::size_t end = 0;
  while (end < text.size() && display_width(text.substr(0, end + 1)) <= count) ++end;
  return end;
}

}  // namespace

std::vector<std::string> broken(std::string_view text, std::size_t most) {
  std::string spaced;
  std::size_t in_line = 0;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    std::string_view word = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    // Longer words begin in the line that there is.
    while (display_width(word) > most) {
      const std::size_t room = in_line + 1 < most ? most - in_line - (in_line > 0 ? 1 : 0) : most;
      const std::size_t bytes = bytes_of(word, room);
      spaced += std::string(word.substr(0, bytes)) + " ";
      word.remove_prefix(bytes);
      in_line = 0;
    }
    const std::size_t width = display_width(word);
    in_line = in_line == 0 || in_line + 1 + width > most ? width : in_line + 1 + width;
    spaced += std::string(word) + " ";
  }
  return wrapped(spaced, most);
}

}  // namespace ridgeloc::results
