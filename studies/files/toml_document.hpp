#pragma once

// Internal to studies: the only header that shows toml++ to the readers of study files.

#include <toml++/toml.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "studies/study/value.hpp"

namespace ridgeloc::studies {

/// Parses a study file and applies "key=value" overrides to it. Nodes remember their file and line.
toml::table parse_document(std::string_view text, const std::string& origin, std::span<const std::string> overrides);

/// "file:line" of a node, or the override that it came from.
std::string place_of(const toml::node& node);

/// Whether a node comes from an override.
bool is_override(const toml::node& node);

/// A value as messages quote it: on one line, shortened where it is long.
std::string text_of(const toml::node& node);

/// A whole number, also where it is written as a real one (1e6), as far as doubles hold each of them: up to 2^53.
std::optional<std::int64_t> whole_number(const toml::node& node);

/// The file that a node names: beside its study file or below it, so that a study from a stranger reads nothing else.
/// What an override names may lie anywhere, and is looked for from the working directory, as all that is typed there.
std::filesystem::path named_file(const toml::node& node, const std::string& label);

/// Throws core::InputError with "place: message".
[[noreturn]] void fail_at(const toml::node& node, const std::string& message);

/// Refuses keys that are not among `allowed`, naming the nearest one.
void check_keys(const toml::table& table, std::string_view table_name, const std::vector<std::string>& allowed);

/// " (did you mean \"points\"?)" where a candidate is near, otherwise " (allowed: ...)".
std::string suggestion(std::string_view name, const std::vector<std::string>& candidates);

/// Reads a node as the value of a setting, within its bounds. `label` is how messages call it.
Value read_setting(const toml::node& node, const Setting& setting, const std::string& label);

/// Reads a list of numbers, which may be empty, or a column of a CSV file.
Samples read_samples(const toml::node& node, const Setting& setting, const std::string& label);

/// Reads a list of positions, which may be empty, or columns of a CSV file.
Positions read_positions(const toml::node& node, const Setting& setting, const std::string& label);

/// Reads the file of a table { file = ..., ... }: columns of a CSV file beside the study, `most` rows at most.
std::vector<std::vector<double>> read_columns_of(const toml::table& table, const std::string& label,
                                                 const std::vector<std::string>& columns, std::size_t most);

/// Reads a map: by name, from a file, made at random, or written where it is used.
Building read_building(const toml::node& node, const Setting& setting, const std::string& label);

/// Reads a node as text, or as a list of texts, one of `choices` each when there are any.
std::string read_text(const toml::node& node, const std::string& label, const std::vector<std::string>& choices = {});
std::vector<std::string> read_texts(const toml::node& node, const std::string& label,
                                    const std::vector<std::string>& choices);

/// Reads a node as a table, an array, an array of tables or a truth value.
const toml::table& read_table(const toml::node& node, std::string_view label);
std::vector<const toml::table*> read_tables(const toml::node& node, std::string_view label);
bool read_bool(const toml::node& node, std::string_view label);

}  // namespace ridgeloc::studies
