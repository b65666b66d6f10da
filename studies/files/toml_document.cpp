#include "studies/files/toml_document.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <optional>
#include <sstream>

#include "core/error.hpp"
#include "core/excerpt.hpp"
#include "core/printable.hpp"
#include "studies/files/csv_columns.hpp"
#include "studies/files/toml_keys.hpp"

namespace ridgeloc::studies {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view override_prefix = "--set ";

toml::table parse(std::string_view text, const std::string& origin) {
  if (const auto line = line_of_deep_key(text))
    throw core::InputError(fmt::format("{}:{}: a key has more than {} parts", origin, *line, most_key_parts));
  try {
    return toml::parse(text, origin);
  } catch (const toml::parse_error& error) {
    throw core::InputError(fmt::format("{}:{}: not valid TOML: {}", origin, error.source().begin.line,
                                       std::string_view(error.description())));
  }
}

/// The key of an override as a position below `end` in a list of `size`.
std::size_t position_in(std::size_t size, std::size_t end, const std::string& key, const std::string& origin) {
  std::size_t index = 0;
  const auto [rest, failure] = std::from_chars(key.data(), key.data() + key.size(), index);
  if (failure == std::errc{} && rest == key.data() + key.size() && index < end) return index;
  throw core::InputError(
      fmt::format("{}: \"{}\" is not a position in a list of {} (they count from 0)", origin, key, size));
}

/// Follows one key of an override's path, making tables that are not there.
toml::node& descend(toml::node& node, const std::string& key, const std::string& origin) {
  if (toml::array* array = node.as_array()) return (*array)[position_in(array->size(), array->size(), key, origin)];
  if (toml::table* table = node.as_table()) {
    if (!table->contains(key))
      table->insert(key, std::move(*toml::parse("new = {}", origin).get_as<toml::table>("new")));
    return *table->get(key);
  }
  throw core::InputError(fmt::format("{}: \"{}\" lies inside a value that is not a table", origin, key));
}

/// Puts a value where the last key of an override's path says: in a list in place of an entry, or behind all of them.
void place(toml::node& parent, const std::string& key, toml::node&& value, const std::string& origin) {
  // Moved, not copied: copies of nodes forget where they came from.
  std::move(value).visit([&](auto&& moved) {
    if (toml::table* table = parent.as_table()) {
      table->insert_or_assign(key, std::forward<decltype(moved)>(moved));
    } else if (toml::array* array = parent.as_array()) {
      const std::size_t index = position_in(array->size(), array->size() + 1, key, origin);
      if (index < array->size()) array->erase(array->cbegin() + static_cast<std::ptrdiff_t>(index));
      array->insert(array->cbegin() + static_cast<std::ptrdiff_t>(index), std::forward<decltype(moved)>(moved));
    } else {
      throw core::InputError(fmt::format("{}: \"{}\" lies inside a value that is not a table", origin, key));
    }
  });
}

void apply_override(toml::table& document, const std::string& text) {
  const std::string origin = std::string(override_prefix) + core::excerpt(text);
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos) {
    throw core::InputError(fmt::format("{}: expected KEY=VALUE, for example scene.depth_m=[2,15]", origin));
  }
  const std::string path = text.substr(0, equals);
  if (line_of_deep_key(text))
    throw core::InputError(fmt::format("{}: a key has more than {} parts", origin, most_key_parts));
  const std::string value = text.substr(equals + 1);

  toml::table parsed;
  try {
    parsed = toml::parse("value = " + value, origin);
    if (parsed.size() != 1) throw core::InputError(origin + ": expected one KEY=VALUE");
  } catch (const toml::parse_error&) {
    // A bare word: shells eat the quotes that TOML wants.
    parsed = toml::parse(fmt::format("value = {}", to_toml(Value(value))), origin);
  }

  toml::node* node = &document;
  std::size_t begin = 0;
  for (std::size_t dot = path.find('.'); dot != std::string::npos; dot = path.find('.', begin)) {
    node = &descend(*node, path.substr(begin, dot - begin), origin);
    begin = dot + 1;
  }
  place(*node, path.substr(begin), std::move(*parsed.get("value")), origin);
}

/// A finite number, whole or not. -0.0, which is equal to 0.0 and would be another text, is 0.0.
std::optional<double> number_of(const toml::node& node) {
  if (!node.is_number()) return std::nullopt;
  const double value = *node.value<double>();
  if (!std::isfinite(value)) return std::nullopt;
  return value == 0.0 ? 0.0 : value;
}

/// As an array or table of the document has it, in one line.
std::string inline_text(const toml::node& node) {
  std::string text;
  if (const toml::array* array = node.as_array()) {
    for (const toml::node& element : *array) text += (text.empty() ? "" : ", ") + inline_text(element);
    return text.empty() ? "[]" : fmt::format("[ {} ]", text);
  }
  if (const toml::table* table = node.as_table()) {
    for (const auto& [key, value] : *table)
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key.str(), inline_text(value));
    return text.empty() ? "{}" : fmt::format("{{ {} }}", text);
  }
  // The shortest form, not the seventeen digits of the library.
  if (node.is_floating_point()) return to_toml(Value(*node.value<double>()));
  std::ostringstream out;
  node.visit([&](const auto& concrete) { out << concrete; });
  return out.str();
}

/// A text that may be written over several lines, as tables and command lines can show it.
std::string in_one_line(const std::string& text) {
  std::istringstream words(text);
  std::string line;
  for (std::string word; words >> word;) line += (line.empty() ? "" : " ") + word;
  return line;
}

std::optional<Value> read_value(const toml::node& node, const Setting& s) {
  const auto within = [&s](double v) { return s.low <= v && v <= s.high; };
  switch (s.kind) {
    case Kind::Integer: {
      const std::optional<std::int64_t> value = whole_number(node);
      return value && within(static_cast<double>(*value)) ? std::optional<Value>(*value) : std::nullopt;
    }
    case Kind::Real: {
      const auto value = number_of(node);
      return value && within(*value) ? std::optional<Value>(*value) : std::nullopt;
    }
    case Kind::Choice: {
      // Choices may look like numbers, and be written as such.
      const auto value = node.is_integer() ? std::to_string(*node.value<std::int64_t>())
                                           : node.value<std::string>().value_or(std::string());
      const bool known = std::ranges::find(s.choices, value) != s.choices.end();
      return known ? std::optional<Value>(value) : std::nullopt;
    }
    case Kind::Text: {
      // A formula may be a number, and be written as such.
      if (s.complaint != nullptr && node.is_number()) return inline_text(node);
      const auto value = node.value_exact<std::string>();
      return value ? std::optional<Value>(in_one_line(*value)) : std::nullopt;
    }
    case Kind::Range: {
      const toml::array* pair = node.as_array();
      if (pair == nullptr || pair->size() != 2) return std::nullopt;
      const auto low = number_of((*pair)[0]);
      const auto high = number_of((*pair)[1]);
      const bool valid = low && high && within(*low) && within(*high) && *low <= *high;
      return valid ? std::optional<Value>(Interval{*low, *high}) : std::nullopt;
    }
    case Kind::Samples:  // never here: they have messages of their own
    case Kind::Positions:
    case Kind::Building:
      break;
  }
  return std::nullopt;
}

/// Folder that paths in a node start from: that of its study file; for an override the working directory, as for all
/// that is typed there.
fs::path folder_of(const toml::node& node) {
  const toml::source_region& source = node.source();
  if (source.path == nullptr || is_override(node)) return {};
  return fs::path(*source.path).parent_path();
}

/// Whether a path lies outside of a folder when all its links are followed, or they cannot be followed. Of a path that
/// is not there nothing is made absolute by itself.
bool leads_out(const fs::path& folder, const fs::path& path) {
  std::error_code folder_unknown;
  std::error_code path_unknown;
  const fs::path inside = fs::weakly_canonical(fs::absolute(folder.empty() ? "." : folder), folder_unknown);
  const fs::path whole = fs::weakly_canonical(fs::absolute(path), path_unknown);
  if (folder_unknown || path_unknown) return true;
  return std::ranges::mismatch(inside, whole).in1 != inside.end();
}

}  // namespace

toml::table parse_document(std::string_view text, const std::string& origin, std::span<const std::string> overrides) {
  toml::table document = parse(text, origin);
  for (const std::string& item : overrides) apply_override(document, item);
  return document;
}

bool is_override(const toml::node& node) {
  const toml::source_region& source = node.source();
  return source.path != nullptr && source.path->starts_with(override_prefix);
}

std::string place_of(const toml::node& node) {
  const toml::source_region& source = node.source();
  if (source.path == nullptr) return "study";
  if (is_override(node)) return *source.path;
  return fmt::format("{}:{}", *source.path, source.begin.line);
}

std::string text_of(const toml::node& node) {
  std::istringstream words(inline_text(node));
  std::string text;
  for (std::string word; words >> word;) text += (text.empty() ? "" : " ") + word;
  return core::excerpt(text);
}

std::filesystem::path named_file(const toml::node& node, const std::string& label) {
  const std::string name = read_text(node, label + ".file");
  const fs::path folder = folder_of(node);
  const fs::path path = folder / name;
  if (!is_override(node) && leads_out(folder, path)) {
    fail_at(node, fmt::format("{}.file: {} lies neither beside the study nor below; move it there, or name it on the "
                              "command line, with --set",
                              label, core::excerpt(name)));
  }
  std::error_code unknown;
  if (!fs::is_regular_file(path, unknown))
    fail_at(node, fmt::format("{}.file: there is no file {}", label, path.string()));
  return path;
}

void fail_at(const toml::node& node, const std::string& message) {
  throw core::InputError(place_of(node) + ": " + message);
}

std::optional<std::int64_t> whole_number(const toml::node& node) {
  if (node.is_integer()) return *node.value<std::int64_t>();
  const auto real = node.is_floating_point() ? node.value<double>() : std::nullopt;
  constexpr double exact = 9007199254740992.0;  // 2^53; from there on doubles skip whole numbers
  if (!real || !(std::fabs(*real) <= exact) || *real != std::floor(*real)) return std::nullopt;
  return static_cast<std::int64_t>(*real);
}

std::string suggestion(std::string_view name, const std::vector<std::string>& candidates) {
  const std::string nearest = nearest_name(name, candidates);
  if (!nearest.empty()) return fmt::format(" (did you mean \"{}\"?)", nearest);
  return candidates.empty() ? "" : fmt::format(" (allowed: {})", fmt::join(candidates, ", "));
}

void check_keys(const toml::table& table, std::string_view table_name, const std::vector<std::string>& allowed) {
  for (const auto& [key, node] : table) {
    if (std::ranges::find(allowed, key.str()) != allowed.end()) continue;
    fail_at(node, fmt::format("unknown key \"{}\" in {}{}", core::excerpt(key.str()), table_name,
                              suggestion(key.str(), allowed)));
  }
}

Value read_setting(const toml::node& node, const Setting& setting, const std::string& label) {
  if (setting.kind == Kind::Samples) return read_samples(node, setting, label);
  if (setting.kind == Kind::Positions) return read_positions(node, setting, label);
  if (setting.kind == Kind::Building) return read_building(node, setting, label);
  auto value = read_value(node, setting);
  if (value && setting.complaint != nullptr && *value != setting.standard) {
    const std::string complaint = setting.complaint(std::get<std::string>(*value));
    if (!complaint.empty()) fail_at(node, fmt::format("{} = {} is not allowed: {}", label, text_of(node), complaint));
  }
  if (value) return *value;
  std::string hint;
  if (setting.kind == Kind::Choice && node.is_string()) {
    const std::string nearest = nearest_name(*node.value<std::string>(), setting.choices);
    if (!nearest.empty()) hint = fmt::format(" (did you mean \"{}\"?)", nearest);
  }
  fail_at(node,
          fmt::format("{} = {} is not allowed: {} takes {}{}", label, text_of(node), label, accepted(setting), hint));
}

std::vector<std::vector<double>> read_columns_of(const toml::table& table, const std::string& label,
                                                 const std::vector<std::string>& columns, std::size_t most) {
  const toml::node* file = table.get("file");
  if (file == nullptr) fail_at(table, fmt::format("{} lacks file; give {{ file = \"NAME.csv\", ... }}", label));
  return read_csv_columns(named_file(*file, label), columns, most);
}

std::string read_text(const toml::node& node, const std::string& label, const std::vector<std::string>& choices) {
  if (!node.is_string())
    fail_at(node, fmt::format("{} = {} is not allowed: {} takes a text", label, text_of(node), label));
  auto text = *node.value<std::string>();
  if (text != core::printable(text)) fail_at(node, fmt::format("{} holds a control character; leave it out", label));
  if (!choices.empty() && std::ranges::find(choices, text) == choices.end()) {
    fail_at(node, fmt::format("{}: unknown \"{}\"{}", label, core::excerpt(text), suggestion(text, choices)));
  }
  return text;
}

std::vector<std::string> read_texts(const toml::node& node, const std::string& label,
                                    const std::vector<std::string>& choices) {
  const toml::array* array = node.as_array();
  if (array == nullptr) return {read_text(node, label, choices)};
  std::vector<std::string> texts;
  for (const toml::node& element : *array) texts.push_back(read_text(element, label, choices));
  if (texts.empty()) fail_at(node, fmt::format("{} is an empty list", label));
  return texts;
}

const toml::table& read_table(const toml::node& node, std::string_view label) {
  const toml::table* table = node.as_table();
  if (table == nullptr) fail_at(node, fmt::format("{} must be a table", label));
  return *table;
}

std::vector<const toml::table*> read_tables(const toml::node& node, std::string_view label) {
  const toml::array* array = node.as_array();
  if (array == nullptr) fail_at(node, fmt::format("{0} must be a list of tables: [[{0}]]", label));
  std::vector<const toml::table*> tables;
  for (const toml::node& element : *array) tables.push_back(&read_table(element, label));
  return tables;
}

bool read_bool(const toml::node& node, std::string_view label) {
  if (!node.is_boolean()) fail_at(node, fmt::format("{} must be true or false", label));
  return *node.value<bool>();
}

}  // namespace ridgeloc::studies
