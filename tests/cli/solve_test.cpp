// Positions from measured ranges, as a user asks for them.

#include <string>

#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

namespace {

/// Anchors of a room, and exact ranges to them from (2, 1, 1) and (6, 4, 1).
struct WithData : WorkingFolder {
  WithData() {
    write("anchors.csv", "object,x_m,y_m,z_m\nA,0,0,1\nB,2,0,1\nC,2,1,4\nD,6,1,1\nE,2,4,1\n");
    write("wide.csv",
          "epoch,A,B,C,D,E\n1,2.23606797749979,1,3,4,3\n2,7.211102550927978,5.656854249492381,5.830951894845301,3,4\n");
    write("long.csv", "t;anchor;mm\n1;A;2236,06797749979\n1;B;1000\n1;C;3000\n1;D;4000\n1;E;3000\n");
  }
};

}  // namespace

TEST_CASE("solve gives a line for each epoch and method, as CSV or JSON, from files and pipes") {
  const WithData folder;
  const Outcome csv = folder.ridgeloc("solve wide.csv --objects anchors.csv --solver ols --solver rrr");
  CHECK(csv.error == "");
  REQUIRE(csv.exit_code == 0);
  CHECK(line_count(csv.out) == 5);
  CHECK(csv.out.starts_with("epoch,method,status,note,x_m,y_m,z_m,iterations,objects,gdop,residual_rms_m,sigma_m,"));
  CHECK(contains(csv.out, "\n1,ols,converged,,"));
  CHECK(contains(csv.out, "\n2,rrr,converged,,"));

  CHECK(folder.shell("cat wide.csv | '" RIDGELOC_PROGRAM "' solve - --objects anchors.csv --solver ols --solver rrr")
            .out == csv.out);
  CHECK(folder.ridgeloc("solve wide.csv --objects anchors.csv --solver ols --solver rrr -o fixes.csv").exit_code == 0);
  CHECK(folder.read("fixes.csv") == csv.out);

  const Outcome json = folder.ridgeloc(
      "solve long.csv --objects anchors.csv --column epoch=t --column object=anchor --column range=mm --unit mm --json "
      "--solver lm --set solver.step_tolerance_m=1e-9");
  REQUIRE(json.exit_code == 0);
  CHECK(contains(json.out, "{\"epoch\":\"1\",\"method\":\"lm\",\"status\":\"converged\",\"note\":\"\",\"x_m\":"));
  CHECK(contains(json.out, "\"residuals\":[{\"object\":\"A\",\"residual_m\":"));
}

TEST_CASE("solve leaves out what cannot be used and says where, or refuses it") {
  const WithData folder;
  folder.write("bad.csv", "epoch,A,B,C,D\n1,2.2,1,3,x\n2,3,4,,\n");
  const Outcome lenient = folder.ridgeloc("solve bad.csv --objects anchors.csv");
  CHECK(lenient.exit_code == 0);
  CHECK(contains(lenient.error, "bad.csv:2: \"x\" in column \"D\" is not a range, a number above 0\n"));
  CHECK(contains(lenient.error, "--strict refuses"));
  CHECK(contains(lenient.out, "\n1,lm,"));
  CHECK(contains(lenient.out, "\n2,lm,too_few_objects,,,,,,2,"));

  const Outcome strict = folder.ridgeloc("solve bad.csv --objects anchors.csv --strict -o fixes.csv");
  CHECK(strict.exit_code == 2);
  CHECK(line_count(strict.error) == 1);
  CHECK(!folder.has("fixes.csv"));

  std::string many = "epoch,A,B,C\n";
  for (int i = 0; i < 30; ++i) many += "1,2,0,3\n";
  folder.write("many.csv", many);
  CHECK(line_count(folder.ridgeloc("solve many.csv --objects anchors.csv").error) == 12);
}

TEST_CASE("solve refuses in one line what it is not told, or told twice") {
  const WithData folder;
  const auto refusal = [&](const std::string& arguments) {
    const Outcome outcome = folder.ridgeloc("solve " + arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(line_count(outcome.error) == 1);
    return outcome.error;
  };
  CHECK(contains(refusal("wide.csv"), "--objects FILE"));
  CHECK(contains(refusal("none.csv --objects anchors.csv"), "none.csv: cannot be read"));
  CHECK(contains(refusal("wide.csv --objects none.csv"), "none.csv: cannot be read"));
  CHECK(contains(refusal("- --objects -"), "standard input"));
  CHECK(contains(refusal("wide.csv --objects anchors.csv --solver rrrr"), "rrr"));
  CHECK(contains(refusal("wide.csv --objects anchors.csv --solver rrr --study fig3a"), "--solver and --study"));
  CHECK(contains(refusal("wide.csv --objects anchors.csv --study fig3a"), "sweeps"));
  CHECK(contains(refusal("wide.csv --objects anchors.csv --column dist=A"), "ROLE=NAME"));
  CHECK(contains(refusal("wide.csv --objects anchors.csv --unit inch"), "--unit"));
  CHECK(contains(refusal("wide.csv --objects anchors.csv --start 1,2"), "--start"));
  CHECK(contains(refusal("wide.csv --objects anchors.csv --sigma 0"), "--sigma"));
  CHECK(contains(refusal("wide.csv --objects anchors.csv --solver rrr --set solver.k=oracle_gm"), "true position"));
}

TEST_CASE("solve writes over nothing that it reads, and over no study") {
  const WithData folder;
  const auto refusal = [&](const std::string& arguments) {
    const Outcome outcome = folder.ridgeloc("solve " + arguments);
    CHECK(outcome.exit_code == 2);
    return outcome.error;
  };
  const std::string data = folder.read("wide.csv");
  CHECK(contains(refusal("wide.csv --objects anchors.csv -o wide.csv"), "would be written over"));
  CHECK(contains(refusal("wide.csv --objects anchors.csv -o f.csv --as-noise anchors.csv"), "would be written over"));
  folder.write("mine.toml", "# mine");
  CHECK(contains(refusal("wide.csv --objects anchors.csv -o f.csv --as-scene mine.toml"), "exists already"));
  CHECK(folder.read("wide.csv") == data);
  CHECK(folder.read("mine.toml") == "# mine");
}

TEST_CASE("one's own errors and places become a study that runs") {
  const WithData folder;
  folder.write("noisy.csv", "A,B,C,D,E\n2.3,1.1,2.9,4.1,3.05\n7.1,5.7,5.8,3.1,4.02\n");
  REQUIRE(
      folder
          .ridgeloc(
              "solve noisy.csv --objects anchors.csv --solver lm --as-noise noise.csv --as-scene mine.toml -o f.csv")
          .exit_code == 0);
  CHECK(line_count(folder.read("noise.csv")) == 11);
  const Outcome run = folder.ridgeloc(
      "run mine.toml --set noise.noise_model=empirical --set "
      "'noise.noise_samples={file=\"noise.csv\",column=\"error_m\"}' -o "
      "mine.h5");
  INFO(run.error);
  CHECK(run.exit_code == 0);
  CHECK(folder.ridgeloc("solve noisy.csv --objects anchors.csv --study mine.toml").exit_code == 0);

  folder.write("few.csv", "A,B,C\n2.3,1.1,2.9\n");
  const Outcome nothing_left = folder.ridgeloc("solve few.csv --objects anchors.csv --as-noise n.csv -o f.csv");
  CHECK(nothing_left.exit_code == 2);
  CHECK(contains(nothing_left.error, "more ranges than unknowns"));
}
