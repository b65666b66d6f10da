#include "studies/measured/object_table.hpp"

#include <sstream>
#include <string>

#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;

namespace {

studies::ObjectTable table_of(const std::string& text, const studies::DataColumns& columns = {}, double unit_m = 1.0) {
  std::istringstream stream(text);
  return studies::read_objects(stream, "objects.csv", columns, unit_m);
}

}  // namespace

TEST_CASE("objects are read by name, in any unit, on the ground where they have no height") {
  const auto table = table_of("id;x_m;object;y_m\n7;1,5;A;2\n8;-1;B;0\n", {}, 0.5);
  REQUIRE(table.size() == 2);
  CHECK(table.at("A") == studies::Place{0.75, 1.0, 0.0});
  CHECK(table.at("B") == studies::Place{-0.5, 0.0, 0.0});

  studies::DataColumns of_data;
  of_data.object = "anchor";
  of_data.x = "east";
  CHECK(table_of("object,east,y_m,z_m\nA,1,2,3\n", of_data).at("A") == studies::Place{1.0, 2.0, 3.0});
  CHECK(table_of("anchor,x_m,y_m,z_m\nA,1,2,3\n", of_data).at("A") == studies::Place{1.0, 2.0, 3.0});
}

TEST_CASE("objects that cannot be used are named with their line") {
  const auto refusal = [](const std::string& text) { return tests::refusal_of([&] { table_of(text); }); };
  CHECK(refusal("name,x_m,y_m\nA,1,2\n") ==
        "objects.csv:1: no column \"object\" (there are: name, x_m, y_m); --column object=NAME says which it is");
  CHECK(refusal("object,x_m,y_m\nA,1,2\nB,1\n") == "objects.csv:3: \"\" in column \"y_m\" is not a number");
  CHECK(refusal("object,x_m,y_m\nA,1,2\nA,3,4\n") == "objects.csv:3: object \"A\" is there twice; leave one out");
  CHECK(refusal("object,x_m,y_m\n,1,2\n") == "objects.csv:2: the object has no name");
  CHECK(refusal("object,x_m,y_m\n") == "objects.csv: no object");
}
