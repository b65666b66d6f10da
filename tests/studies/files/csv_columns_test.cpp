#include "studies/files/csv_columns.hpp"

#include <filesystem>
#include <fstream>
#include <string>

#include "core/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;

namespace {

/// A file of its own, removed at the end.
class File {
 public:
  explicit File(const std::string& text) : path_(folder_ / "column.csv") {
    std::ofstream(path_, std::ios::binary) << text;
  }

  const std::filesystem::path& path() const { return path_; }

 private:
  tests::ScratchFolder folder_;
  std::filesystem::path path_;
};

std::vector<double> column(const std::string& text, const std::string& name, std::size_t most = 100) {
  const File file(text);
  return studies::read_csv_columns(file.path(), {name}, most).front();
}

/// The message without the path in front.
std::string csv_error_of(const std::string& text, const std::string& name) {
  const File file(text);
  const std::string message = tests::refusal_of([&] { studies::read_csv_columns(file.path(), {name}, 100); });
  if (message.empty()) return "";
  REQUIRE(message.starts_with(file.path().string()));
  return message.substr(file.path().string().size());
}

}  // namespace

TEST_CASE("a column of a CSV file is read by its name") {
  const std::vector<double> expected = {1.5, -2.0, 3e-2};
  CHECK(column("id,e_m\n1,1.5\n2,-2\n3,3e-2\n", "e_m") == expected);
  CHECK(column("id,e_m\r\n1,1.5\r\n\r\n2,-2\r\n3,+0.03", "e_m") == expected);
  CHECK(column("\xef\xbb\xbf"
               "e_m , id\n 1.5 ,1\n-2,2\n3e-2\t,3\n\n",
               "e_m") == expected);
  CHECK(column("\"a, \"\"b\"\"\",e_m\n\"x\ny\",\"1.5\"\n,-2\n\"\",3e-2\n", "e_m") == expected);
  CHECK(column("\"a, \"\"b\"\"\",e_m\n1.5,x\n", "a, \"b\"") == std::vector<double>{1.5});
  CHECK(column("e_m\n1\n2\n3\n", "e_m", 2) == std::vector<double>{1.0, 2.0});
  CHECK(column("e_m\n", "e_m").empty());
}

TEST_CASE("a CSV file with semicolons has decimal commas or points") {
  const std::vector<double> expected = {0.1, -0.25, 3.0};
  CHECK(column("e_m;x_m\n0,1;2\n-0,25;3\n3;4\n", "e_m") == expected);
  CHECK(column("\xef\xbb\xbf\"id\";e_m\r\n1;0,1\r\n2;-2,5e-1\r\n3;3.0\r\n", "e_m") == expected);
  CHECK(csv_error_of("e_m;x_m\n1.234,5;2\n", "e_m") == ":2: \"1.234,5\" in column \"e_m\" is not a number");
  CHECK(column("e_m,x;y\n1,0;2\n", "e_m") == std::vector<double>{1.0});
}

TEST_CASE("what is wrong in a CSV file is named with its line") {
  CHECK(csv_error_of("id,e_m\n1,2\n", "em") == ":1: no column \"em\" (did you mean \"e_m\"?)");
  CHECK(csv_error_of("id,e_m\n1,2\n", "residual") == ":1: no column \"residual\" (there are: id, e_m)");
  CHECK(csv_error_of("", "e_m").starts_with(":1: no column \"e_m\""));
  CHECK(csv_error_of("id,e_m\n1,2\n\n2,3 m\n", "e_m") == ":4: \"3 m\" in column \"e_m\" is not a number");
  CHECK(csv_error_of("id,e_m\n\"a\nb\",2\n2,\n", "e_m") == ":4: \"\" in column \"e_m\" is not a number");
  CHECK(csv_error_of("id,e_m\n1\n", "e_m") == ":2: \"\" in column \"e_m\" is not a number");
  CHECK(csv_error_of("e_m\nnan\n", "e_m") == ":2: \"nan\" in column \"e_m\" is not a number");
  CHECK(csv_error_of("e_m\n1e999\n", "e_m") == ":2: \"1e999\" in column \"e_m\" is not a number");
}

TEST_CASE("a row with more cells than the first line is an error: decimal commas") {
  CHECK(csv_error_of("e\n1,5\n2,5\n", "e") ==
        ":2: 2 cells where the first line names 1; is a comma the decimal point?");
}

TEST_CASE("several columns are read in the order asked for") {
  const File file("z,x,y\n3,1,2\n6,4,5\n");
  const std::vector<std::vector<double>> expected = {{1, 4}, {2, 5}, {3, 6}};
  CHECK(studies::read_csv_columns(file.path(), {"x", "y", "z"}, 9) == expected);
}

TEST_CASE("files of spreadsheets have semicolons or tabulators, and decimal commas") {
  const std::vector<double> expected = {0.1, -0.25, 1e-3};
  CHECK(column("e_m;x_m\n0,1;2\n-0,25;3\n1e-3;4\n", "e_m") == expected);
  CHECK(column("x_m\te_m\r\n2\t0,1\r\n3 \t -0.25\r\n4\t0,001\r\n", "e_m") == expected);
  CHECK(column("x_m\te_m\n\t0.1\n", "e_m") == std::vector<double>{0.1});
  CHECK(column("\"a,b\";e_m\n1;0,1\n", "e_m") == std::vector<double>{0.1});
  // A comma in the first line separates, and semicolons are then like other signs.
  CHECK(column("a;b,e_m\n1;2,0.1\n", "e_m") == std::vector<double>{0.1});
  CHECK(csv_error_of("e_m;x_m\n1.000,5;2\n", "e_m") == ":2: \"1.000,5\" in column \"e_m\" is not a number");
  CHECK(csv_error_of("e_m;x_m\n1,2,3;2\n", "e_m") == ":2: \"1,2,3\" in column \"e_m\" is not a number");
  CHECK(csv_error_of("e_m;x_m\n1;2;3\n", "e_m").starts_with(":2: 3 cells where the first line names 2"));
}

TEST_CASE("a file that is not there is an error") {
  CHECK_THROWS_AS(studies::read_csv_columns("/nowhere/residuals.csv", {"e_m"}, 9), core::InputError);
}

TEST_CASE("names and cells of several lines are quoted in one") {
  CHECK(csv_error_of("x,e\n1,\"a\nb\"\n", "e") == ":2: \"a b\" in column \"e\" is not a number");
  CHECK(csv_error_of("\"x\ny\",zzz\n1,2\n", "e_m") == ":1: no column \"e_m\" (there are: x y, zzz)");
}
