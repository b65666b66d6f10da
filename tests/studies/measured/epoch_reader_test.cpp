#include "studies/measured/epoch_reader.hpp"

#include <sstream>
#include <string>
#include <vector>

#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;
using studies::Epoch;

namespace {

const studies::ObjectTable anchors = {{"A", {0, 0, 2}}, {"B", {8, 0, 2}}, {"C", {8, 6, 1}}};

struct Read {
  std::vector<Epoch> epochs;
  std::vector<std::string> complaints;
};

Read read(const std::string& text, const studies::DataFormat& format = {},
          const studies::ObjectTable& objects = anchors) {
  std::istringstream stream(text);
  Read out;
  studies::EpochReader reader(stream, "data.csv", format, objects,
                              [&](const std::string& message) { out.complaints.push_back(message); });
  for (Epoch epoch; reader.next(epoch);) out.epochs.push_back(epoch);
  return out;
}

std::string refusal_of(const std::string& text, const studies::ObjectTable& objects = anchors) {
  return tests::refusal_of([&] { read(text, {}, objects); });
}

}  // namespace

TEST_CASE("epochs are read one a row, the objects as columns, an empty cell for what was not measured") {
  const studies::DataFormat millimetres{.columns = {}, .range_unit_m = 0.001};
  const Read found = read("epoch,B,temperature,A,C\nt0,4000,21,3000,\nt1,,21,,5000\n", millimetres);
  CHECK(found.complaints.empty());
  REQUIRE(found.epochs.size() == 2);
  CHECK(found.epochs[0].label == "t0");
  CHECK(found.epochs[0].line == 2);
  REQUIRE(found.epochs[0].readings.size() == 2);
  CHECK(found.epochs[0].readings[0].object == "B");
  CHECK(found.epochs[0].readings[0].at == anchors.at("B"));
  CHECK(found.epochs[0].readings[0].range_m == 4.0);
  CHECK(found.epochs[0].readings[1].object == "A");
  CHECK(found.epochs[1].readings.size() == 1);

  const Read numbered = read("A,B\n3,4\n5,6\n");
  REQUIRE(numbered.epochs.size() == 2);
  CHECK(numbered.epochs[1].label == "2");
}

TEST_CASE("epochs are read one reading a row, with names of objects or with coordinates, and scores") {
  const studies::DataFormat format{.columns = {.epoch = "t", .range = "dist"}};
  const Read named = read("t,object,dist,score\n1,A,3,0.5\n1,C,4,1\n2,B,5,1\n", format);
  CHECK(named.complaints.empty());
  REQUIRE(named.epochs.size() == 2);
  REQUIRE(named.epochs[0].readings.size() == 2);
  CHECK(named.epochs[0].readings[0].score == 0.5);
  CHECK(named.epochs[0].readings[1].at == anchors.at("C"));
  CHECK(named.epochs[1].line == 4);

  const studies::DataFormat kilometres{.columns = {}, .range_unit_m = 1.0, .position_unit_m = 1000.0};
  const Read placed = read("epoch,x_m,y_m,range_m\n1,1,2,3\n", kilometres, {});
  REQUIRE(placed.epochs.size() == 1);
  CHECK(placed.epochs[0].readings[0].at == studies::Place{1000.0, 2000.0, 0.0});
  CHECK(placed.epochs[0].readings[0].object.empty());
}

TEST_CASE("readings that are none are left out and named with their line") {
  const Read rows = read(
      "epoch,object,range_m,score\n1,A,3,1\n1,lamp,3,1\n1,B,-3,1\n1,B,x,1\n1,B,3,0\n1,B,1,5,1\n1,C,4,1\n2,A,3,1\n1,B,3,"
      "1\n");
  REQUIRE(rows.epochs.size() == 3);
  CHECK(rows.epochs[0].readings.size() == 2);
  REQUIRE(rows.complaints.size() == 6);
  CHECK(rows.complaints[0] == "data.csv:3: no object \"lamp\"");
  CHECK(rows.complaints[1] == "data.csv:4: \"-3\" in column \"range_m\" is not a range, a number above 0");
  CHECK(rows.complaints[2] == "data.csv:5: \"x\" in column \"range_m\" is not a range, a number above 0");
  CHECK(rows.complaints[3] == "data.csv:6: \"0\" in column \"score\" is not a score, a number above 0 and up to 1");
  CHECK(rows.complaints[4] == "data.csv:7: 5 cells where the first line names 4; is a comma the decimal point?");
  CHECK(rows.complaints[5] ==
        "data.csv:10: epoch \"1\" has been before: the rows of an epoch stand together, and here it is another one");

  const Read columns = read("A,B,C\n3,?,4\n");
  REQUIRE(columns.complaints.size() == 1);
  CHECK(columns.complaints[0] == "data.csv:2: \"?\" in column \"B\" is not a range, a number above 0");
  CHECK(columns.epochs[0].readings.size() == 2);
}

TEST_CASE("an epoch whose row cannot be read keeps its place") {
  const Read columns = read("epoch,A,B,C\n1,3,4,5\n2,3,4,5,6\n3,3,\"4,5\n");
  REQUIRE(columns.epochs.size() == 3);
  CHECK(columns.epochs[1].label == "2");
  CHECK(columns.epochs[1].readings.empty());
  CHECK(columns.epochs[2].readings.empty());
  REQUIRE(columns.complaints.size() == 2);
  CHECK(columns.complaints[1] == "data.csv:4: a quote that is not closed");
  // Where an epoch is a row there is nothing to stand together.
  CHECK(read("epoch,A,B,C\n1,3,4,5\n1,3,4,5\n").complaints.empty());
}

TEST_CASE("what is quoted from data is short and plain") {
  const Read found = read("epoch,object,range_m\n1,A,\x1b[31m" + std::string(500, 'x') + "\n");
  REQUIRE(found.complaints.size() == 1);
  CHECK(found.complaints[0].size() < 200);
  CHECK(found.complaints[0].find('\x1b') == std::string::npos);
  CHECK(refusal_of("") == "data.csv: is empty; the first line names the columns");
}

TEST_CASE("data that say not what they are, are refused with what is there") {
  CHECK(
      refusal_of("t,D\n1,2\n") ==
      "data.csv: neither a column \"range_m\" with one range a row nor columns called after objects (there are: t, D); "
      "--column range=NAME says which has the ranges");
  CHECK(refusal_of("object,range_m\nA,2\n") ==
        "data.csv: no column \"epoch\" (there are: object, range_m); --column epoch=NAME says which ranges belong "
        "together");
  CHECK(refusal_of("epoch,object,range_m\n1,A,2\n", {}) ==
        "data.csv: where the objects are is not said (there are: epoch, object, range_m): give columns \"x_m\", "
        "\"y_m\" and "
        "\"z_m\", or a column \"object\" with their names and --objects FILE");
}
