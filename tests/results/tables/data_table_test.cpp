#include "results/tables/data_table.hpp"

#include <limits>
#include <string>

#include "results/util/json.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace ridgeloc::results;

DataTable sample() {
  DataTable table{"steps", {"step", "x_m", "note", "k", "weights", "taken"}, {}};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  table.add_row(std::int64_t{0}, 0.1, "a \"b\"", Field(), std::vector<double>{1.0, 0.25}, true);
  table.add_row(std::int64_t{10}, -1234567.8, "µ", Field(), std::vector<double>{nan}, false);
  return table;
}

TEST_CASE("a table as text is aligned and leaves out what is empty") {
  CHECK(table_text(sample()) ==
        "steps\n"
        "  step           x_m  note   weights  taken\n"
        "     0           0.1  a \"b\"  1 0.25     yes\n"
        "    10  -1.23457e+06  µ      nan         no\n");
}

TEST_CASE("a table as JSON keeps every bit, and has null for what is no number") {
  CHECK(table_json(sample(), 2) ==
        "[\n"
        "    {\"step\": 0, \"x_m\": 0.1, \"note\": \"a \\\"b\\\"\", \"k\": null, \"weights\": [1, 0.25], "
        "\"taken\": true},\n"
        "    {\"step\": 10, \"x_m\": -1234567.8, \"note\": \"µ\", \"k\": null, \"weights\": [null], "
        "\"taken\": false}\n"
        "  ]");
  CHECK(table_json({"empty", {"a"}, {}}, 2) == "[]");
}

TEST_CASE("JSON strings and numbers are valid whatever they hold") {
  CHECK(json_string("tab\t, \\ and \"\n") == "\"tab\\u0009, \\\\ and \\\"\\u000a\"");
  CHECK(json_number(0.1 + 0.2) == "0.30000000000000004");
  CHECK(json_number(-std::numeric_limits<double>::infinity()) == "null");
}

}  // namespace
