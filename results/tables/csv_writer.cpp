#include "results/tables/csv_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <iterator>
#include <ostream>
#include <string>
#include <variant>

#include "core/error.hpp"
#include "results/schema/text.hpp"

namespace ridgeloc::results {

namespace {

bool is_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  return failure == std::errc{} && end == text.data() + text.size();
}

}  // namespace

CsvWriter::CsvWriter(std::ostream& out, DecimalMark mark) : out_(out), mark_(mark) {}

void CsvWriter::text(std::string_view value) {
  separate();
  constexpr std::string_view computed = "=+-@\t\r";
  if (value.empty() || computed.find(value.front()) == std::string_view::npos || is_number(value)) {
    quoted(value);
  } else {
    quoted(fmt::format("'{}", value));
  }
}

void CsvWriter::quoted(std::string_view value) {
  const std::string_view special = mark_ == DecimalMark::Comma ? ";\"\r\n" : ",\"\r\n";
  if (value.find_first_of(special) == std::string_view::npos) {
    buffer_.append(value);
    return;
  }
  buffer_.push_back('"');
  for (const char c : value) {
    if (c == '"') buffer_.push_back('"');
    buffer_.push_back(c);
  }
  buffer_.push_back('"');
}

void CsvWriter::number(double value) {
  separate();
  std::string text = exact_text(value);
  if (mark_ == DecimalMark::Comma) std::ranges::replace(text, '.', ',');
  buffer_.append(text);
}

void CsvWriter::number(std::uint64_t value) {
  separate();
  fmt::format_to(std::back_inserter(buffer_), "{}", value);
}

void CsvWriter::factor(const FactorValue& value) {
  if (const auto* text_value = std::get_if<std::string>(&value)) {
    text(*text_value);
  } else if (const auto* real = std::get_if<double>(&value)) {
    number(*real);
  } else {
    separate();
    buffer_.append(factor_text(value));
  }
}

void CsvWriter::end_line() {
  buffer_.push_back('\n');
  line_started_ = false;
  constexpr std::size_t piece = std::size_t{1} << 16;
  if (buffer_.size() >= piece) flush();
}

void CsvWriter::flush() {
  out_.write(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
  buffer_.clear();
  if (!out_.flush()) throw core::IoError("cannot write the CSV output: is the disk full or the reader gone?");
}

void CsvWriter::separate() {
  if (line_started_) buffer_.push_back(mark_ == DecimalMark::Comma ? ';' : ',');
  line_started_ = true;
}

}  // namespace ridgeloc::results
