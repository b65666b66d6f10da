#pragma once

#include <cstdint>
#include <iosfwd>
#include <string>
#include <string_view>

#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// How numbers are written in CSV: 0.5 with commas between the cells, or 0,5 with semicolons, as spreadsheets of many
/// countries read it.
enum class DecimalMark { Point, Comma };

/// Writes cells of CSV, quoted where needed, and hands them to the stream in large pieces. Throws core::IoError when
/// the stream fails.
class CsvWriter {
 public:
  CsvWriter(std::ostream& out, DecimalMark mark);

  /// A text that begins with = + - or @ gets an apostrophe before it, so that a spreadsheet shows it and computes
  /// nothing; a number is left as it is.
  void text(std::string_view value);

  /// In the shortest form that reads back as the same double.
  void number(double value);
  void number(std::uint64_t value);

  /// A number as such, a text as such.
  void factor(const FactorValue& value);

  void end_line();
  void flush();

 private:
  void separate();
  void quoted(std::string_view value);

  std::ostream& out_;
  std::string buffer_;
  DecimalMark mark_;
  bool line_started_ = false;
};

}  // namespace ridgeloc::results
