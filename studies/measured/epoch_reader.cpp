#include "studies/measured/epoch_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/excerpt.hpp"
#include "studies/study/value.hpp"

namespace ridgeloc::studies {

EpochReader::EpochReader(std::istream& text, std::string origin, DataFormat format, const ObjectTable& objects,
                         Complain complain)
    : rows_(text),
      origin_(std::move(origin)),
      format_(std::move(format)),
      objects_(objects),
      complain_(std::move(complain)) {
  rows_.next(names_);
  const auto column = [&](const std::string& name) -> std::optional<std::size_t> {
    const auto found = std::ranges::find(names_, name);
    if (found == names_.end()) return std::nullopt;
    return static_cast<std::size_t>(found - names_.begin());
  };
  const DataColumns& known = format_.columns;
  if (names_.empty()) throw core::InputError(fmt::format("{}: is empty; the first line names the columns", origin_));
  const auto there_are = [&] {
    return fmt::format("(there are: {})", core::excerpt(fmt::format("{}", fmt::join(names_, ", "))));
  };
  epoch_ = column(known.epoch);
  range_ = column(known.range);
  if (!range_) {
    for (std::size_t i = 0; i < names_.size(); ++i) {
      const auto object = objects_.find(names_[i]);
      if (object != objects_.end()) object_columns_.emplace_back(i, &*object);
    }
    if (object_columns_.empty()) {
      throw core::InputError(fmt::format(
          "{}: neither a column \"{}\" with one range a row nor columns called after objects {}; --column range=NAME "
          "says which has the ranges{}",
          origin_, known.range, there_are(), objects_.empty() ? ", --objects FILE where the objects are" : ""));
    }
    return;
  }
  if (!epoch_)
    throw core::InputError(fmt::format("{}: no column \"{}\" {}; --column epoch=NAME says which ranges belong together",
                                       origin_, known.epoch, there_are()));
  object_ = column(known.object);
  score_ = column(known.score);
  coordinates_ = {column(known.x), column(known.y), column(known.z)};
  const bool has_places = coordinates_[0] && coordinates_[1];
  if (!has_places && (!object_ || objects_.empty())) {
    throw core::InputError(
        fmt::format("{}: where the objects are is not said {}: give columns \"{}\", \"{}\" and \"{}\", or a column "
                    "\"{}\" with their "
                    "names and --objects FILE",
                    origin_, there_are(), known.x, known.y, known.z, known.object));
  }
  if (!objects_.empty() && object_) coordinates_ = {};
}

bool EpochReader::next(Epoch& epoch) {
  epoch.readings.clear();
  const bool found = range_ ? next_of_rows(epoch) : next_of_columns(epoch);
  if (found) ++epochs_;
  return found;
}

bool EpochReader::read_row() {
  if (has_row_) return true;
  if (!rows_.next(cells_)) return false;
  has_row_ = true;
  is_usable_ = false;
  if (cells_.size() > names_.size()) {
    complain(fmt::format("{} cells where the first line names {}; is a comma the decimal point?", cells_.size(),
                         names_.size()));
  } else if (rows_.is_unclosed()) {
    complain("a quote that is not closed");
  } else {
    is_usable_ = true;
  }
  cells_.resize(names_.size());
  return true;
}

bool EpochReader::next_of_rows(Epoch& epoch) {
  if (!read_row()) return false;
  epoch.label = cells_[*epoch_];
  epoch.line = rows_.line();
  note_label(epoch.label);
  do {
    if (auto reading = is_usable_ ? reading_of_row() : std::nullopt) epoch.readings.push_back(std::move(*reading));
    has_row_ = false;
  } while (read_row() && cells_[*epoch_] == epoch.label);
  return true;
}

bool EpochReader::next_of_columns(Epoch& epoch) {
  if (!read_row()) return false;
  has_row_ = false;
  epoch.label = epoch_ ? cells_[*epoch_] : std::to_string(epochs_ + 1);
  epoch.line = rows_.line();
  if (!is_usable_) return true;
  for (const auto& [position, object] : object_columns_) {
    if (cells_[position].empty()) continue;
    if (const auto range = range_in(cells_[position], object->first))
      epoch.readings.push_back({object->first, object->second, *range, 1.0});
  }
  return true;
}

std::optional<Reading> EpochReader::reading_of_row() {
  Reading reading;
  if (object_) reading.object = cells_[*object_];
  if (!coordinates_[0]) {
    const auto object = objects_.find(reading.object);
    if (object == objects_.end()) {
      complain(fmt::format("no object \"{}\"{}", core::excerpt(reading.object), suggestion_for(reading.object)));
      return std::nullopt;
    }
    reading.at = object->second;
  }
  for (std::size_t axis = 0; axis < coordinates_.size(); ++axis) {
    if (!coordinates_[axis]) continue;
    const std::string& cell = cells_[*coordinates_[axis]];
    const auto value = rows_.number_in(cell);
    if (!value) {
      complain(
          fmt::format("\"{}\" in column \"{}\" is not a number", core::excerpt(cell), names_[*coordinates_[axis]]));
      return std::nullopt;
    }
    reading.at[axis] = *value * format_.position_unit_m;
  }
  const auto range = range_in(cells_[*range_], names_[*range_]);
  if (!range) return std::nullopt;
  reading.range_m = *range;
  if (score_) {
    const auto score = rows_.number_in(cells_[*score_]);
    if (!score || *score <= 0.0 || *score > 1.0) {
      complain(fmt::format("\"{}\" in column \"{}\" is not a score, a number above 0 and up to 1",
                           core::excerpt(cells_[*score_]), names_[*score_]));
      return std::nullopt;
    }
    reading.score = *score;
  }
  return reading;
}

std::optional<double> EpochReader::range_in(const std::string& cell, const std::string& column) {
  const auto value = rows_.number_in(cell);
  if (value && *value > 0.0) return *value * format_.range_unit_m;
  complain(fmt::format("\"{}\" in column \"{}\" is not a range, a number above 0", core::excerpt(cell), column));
  return std::nullopt;
}

std::string EpochReader::suggestion_for(const std::string& object) {
  // A name that is wrong once is often wrong all the way.
  constexpr std::size_t most = 100;
  const auto known = suggestions_.find(object);
  if (known != suggestions_.end()) return known->second;
  if (suggestions_.size() == most) return "";
  std::vector<std::string> names;
  for (const auto& entry : objects_) names.push_back(entry.first);
  const std::string nearest = nearest_name(object, names);
  return suggestions_[object] = nearest.empty() ? "" : fmt::format(", did you mean \"{}\"?", nearest);
}

void EpochReader::note_label(const std::string& label) {
  if (!seen_.insert(std::hash<std::string>{}(label)).second)
    complain(
        fmt::format("epoch \"{}\" has been before: the rows of an epoch stand together, and here it is another one",
                    core::excerpt(label)));
}

void EpochReader::complain(const std::string& what) {
  complain_(fmt::format("{}:{}: {}", origin_, rows_.line(), what));
}

}  // namespace ridgeloc::studies
