#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

TEST_CASE("new makes a study that runs") {
  const WorkingFolder folder;
  REQUIRE(folder.ridgeloc("new ranging -o mine.toml").exit_code == 0);
  CHECK(folder.ridgeloc("new ranging").out == folder.read("mine.toml"));
  CHECK(folder.ridgeloc("new ranging -o mine.toml").exit_code == 2);
  CHECK(folder.ridgeloc("run mine.toml --trials 20").exit_code == 0);
  CHECK(folder.has("mine.h5"));
}

TEST_CASE("new makes a study that runs of every experiment") {
  const WorkingFolder folder;
  for (const std::string name : {"building", "detection"}) {
    REQUIRE(folder.ridgeloc("new " + name + " -o " + name + ".toml").exit_code == 0);
    CHECK(folder.ridgeloc("run " + name + ".toml --trials 20").exit_code == 0);
    CHECK(folder.ridgeloc("summary " + name + ".h5").exit_code == 0);
    const Outcome audited = folder.ridgeloc("run " + name + ".toml --audit 0.5");
    CHECK(audited.exit_code == 2);
    CHECK(contains(audited.error, "Ceres solves no trial of experiment \"" + name + "\" again"));
  }
}
