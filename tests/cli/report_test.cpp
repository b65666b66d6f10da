#include "tests/cli/small_result.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

TEST_CASE("report writes one page, of one result or of several, and never over a result") {
  const WithResult folder;
  const auto one = folder.ridgeloc("report result.h5");
  CHECK(one.exit_code == 0);
  CHECK(one.out == "result.html\n");
  const std::string page = folder.read("result.html");
  CHECK(page.starts_with("<!DOCTYPE html>"));
  CHECK(contains(page, "<title>A small study</title>"));
  CHECK(page.find(": best in ") < page.find(">Overview</h2>"));
  CHECK(contains(page, "ridgeloc plot result.h5 --figure rate"));
  CHECK(folder.ridgeloc("report result.h5 result.h5").out == "report.html\n");
  CHECK(contains(folder.read("report.html"), "<title>2 studies</title>"));
  REQUIRE(folder.ridgeloc("run study.toml --set 'figure=[]' --trials 60 -o other.h5").exit_code == 0);
  CHECK(folder.ridgeloc("report other.h5 -o pages.html").exit_code == 0);
  CHECK(contains(folder.read("pages.html"), "The study asks for none"));

  const std::string result = folder.read("result.h5");
  CHECK(folder.ridgeloc("report other.h5 -o result.h5").exit_code == 2);
  CHECK(folder.read("result.h5") == result);
  CHECK(folder.ridgeloc("report other.h5 -o nowhere/at/all.html").exit_code == 2);
  CHECK(folder.shell("head -c 20000 result.h5 > cut.h5").exit_code == 0);
  const auto damaged = folder.ridgeloc("report result.h5 cut.h5 -o both.html");
  CHECK(damaged.exit_code == 2);
  CHECK(lines_of(damaged.error).size() == 1);
  CHECK_FALSE(folder.has("both.html"));
}

TEST_CASE("the commands of a report do what they say") {
  const WithResult folder;
  REQUIRE(folder.shell("mv result.h5 \"it's a result.h5\"").exit_code == 0);
  REQUIRE(folder.ridgeloc("report \"it's a result.h5\" -o page.html").exit_code == 0);
  const std::string page = folder.read("page.html");
  const std::string command = "ridgeloc verify 'it'\\''s a result.h5'";
  CHECK(contains(page, command));
  CHECK(folder.ridgeloc(command.substr(std::string("ridgeloc ").size())).exit_code == 0);
}
