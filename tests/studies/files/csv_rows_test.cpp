#include "studies/files/csv_rows.hpp"

#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

using Cells = std::vector<std::string>;

/// The rows of a text with the lines that they begin at.
std::vector<std::pair<std::size_t, Cells>> rows_of(const std::string& text) {
  std::istringstream stream(text);
  studies::CsvRows rows(stream);
  std::vector<std::pair<std::size_t, Cells>> all;
  for (Cells cells; rows.next(cells);) all.emplace_back(rows.line(), cells);
  return all;
}

}  // namespace

TEST_CASE("rows of CSV: quotes, blanks, empty lines, ends of lines, a byte order mark") {
  using Rows = std::vector<std::pair<std::size_t, Cells>>;
  CHECK(rows_of("") == Rows{});
  CHECK(rows_of("\n\r\n") == Rows{});
  CHECK(rows_of("\xef\xbb\xbf"
                "a, b \t,\"c,\"\"q\"\"\"\r\n\r\n1,,\n") == Rows{{1, {"a", "b", "c,\"q\""}}, {3, {"1", "", ""}}});
  CHECK(rows_of("a,b\n\"two\nlines\",2\n3,4") == Rows{{1, {"a", "b"}}, {2, {"two\nlines", "2"}}, {4, {"3", "4"}}});
  CHECK(rows_of("a;b\n1,5;2") == Rows{{1, {"a", "b"}}, {2, {"1,5", "2"}}});
  CHECK(rows_of("a\n\"never closed") == Rows{{1, {"a"}}, {2, {"never closed\n"}}});
}

TEST_CASE("a quote that is not closed is told, at the end and where it goes on without end") {
  const auto unclosed = [](const std::string& text) {
    std::istringstream stream(text);
    studies::CsvRows rows(stream);
    std::vector<bool> all;
    for (Cells cells; rows.next(cells);) all.push_back(rows.is_unclosed());
    return all;
  };
  CHECK(unclosed("a,b\n\"c\",d\n\"e\n") == std::vector<bool>{false, false, true});
  std::string long_text = "\"";
  for (int i = 0; i < 40'000; ++i) long_text += "0123456789012345678901234567890123456789\n";
  CHECK(unclosed(long_text).front());
}

TEST_CASE("numbers of CSV: with a decimal comma only where commas do not separate") {
  const auto number_in = [](const std::string& first_line, const std::string& cell) {
    std::istringstream stream(first_line);
    studies::CsvRows rows(stream);
    Cells cells;
    rows.next(cells);
    return rows.number_in(cell);
  };
  CHECK(number_in("a,b", "-1.5e1") == -15.0);
  CHECK(number_in("a,b", "+2") == 2.0);
  CHECK(number_in("a;b", "0,25") == 0.25);
  CHECK(number_in("a;b", "0.25") == 0.25);
  for (const char* none : {"", "x", "1 m", "1,5", "nan", "inf", "1e999", "--1"}) CHECK(!number_in("a,b", none));
  for (const char* none : {"1,000,000", "1.000,5"}) CHECK(!number_in("a;b", none));
}
