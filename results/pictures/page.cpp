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

std::vector<std::string> broken(std::string_view text, std::size_t most) {
  std::string spaced;
  std::size_t in_word = 0;
  for (const char c : text) {
    // A character goes with the bytes that continue it.
    const bool begins_character = display_width(std::string_view(&c, 1)) > 0;
    if (begins_character && in_word == most) {
      spaced += ' ';
      in_word = 0;
    }
    spaced += c;
    in_word = c == ' ' ? 0 : in_word + (begins_character ? 1 : 0);
  }
  return wrapped(spaced, most);
}

}  // namespace ridgeloc::results
