#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <istream>
#include <map>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "studies/files/csv_rows.hpp"
#include "studies/measured/data_columns.hpp"
#include "studies/measured/epoch.hpp"
#include "studies/measured/object_table.hpp"

namespace ridgeloc::studies {

/// How a file of measured data is to be understood.
struct DataFormat {
  DataColumns columns;
  double range_unit_m = 1.0;     ///< of the ranges
  double position_unit_m = 1.0;  ///< of coordinates in the data
};

/// Reads epochs from a CSV text one after the other, so that it may be a pipe and of any size. Two layouts:
///
/// - one reading a row: the columns epoch, range and either object, looked up in a table of objects, or coordinates;
///   score if there is such a column. The rows of an epoch stand together;
/// - one epoch a row: a column for each object, called by its name, with the range to it or nothing; epoch if there is
///   such a column, otherwise epochs are numbered from 1.
class EpochReader {
 public:
  /// What is done about a reading that is not one: told where and what, it returns to leave it out, or throws.
  using Complain = std::function<void(const std::string& message)>;

  /// `objects` may be empty, `origin` is what messages call the text. Throws core::InputError where the first line has
  /// neither layout.
  EpochReader(std::istream& text, std::string origin, DataFormat format, const ObjectTable& objects, Complain complain);

  /// The next epoch, or false at the end. An epoch whose readings were all left out has none.
  bool next(Epoch& epoch);

 private:
  bool next_of_rows(Epoch& epoch);
  bool next_of_columns(Epoch& epoch);
  std::optional<Reading> reading_of_row();
  std::optional<double> range_in(const std::string& cell, const std::string& column);
  void note_label(const std::string& label);
  std::string suggestion_for(const std::string& object);
  void complain(const std::string& what);
  bool read_row();

  CsvRows rows_;
  std::string origin_;
  DataFormat format_;
  const ObjectTable& objects_;
  Complain complain_;
  std::vector<std::string> names_;
  std::vector<std::string> cells_;
  bool has_row_ = false;    ///< `cells_` is a row that no epoch has had yet
  bool is_usable_ = false;  ///< and its cells are what the first line says
  std::optional<std::size_t> epoch_;
  std::optional<std::size_t> object_;
  std::optional<std::size_t> range_;
  std::optional<std::size_t> score_;
  std::array<std::optional<std::size_t>, 3> coordinates_;
  std::vector<std::pair<std::size_t, const ObjectTable::value_type*>> object_columns_;  ///< of one epoch a row
  std::size_t epochs_ = 0;
  std::unordered_set<std::size_t> seen_;  ///< hashes of labels
  std::map<std::string, std::string> suggestions_;
};

}  // namespace ridgeloc::studies
