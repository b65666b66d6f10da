// Standard streams that are closed, full, or whose reader has gone: what is only said ends nothing that is computed.

#include "results/store/result_file.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

const std::string study = R"(experiment = "ranging"
trials = 60000
audit = 0
[sweep]
points = [3, 5]
[[method]]
solver = "ols"
)";

const std::string program = "'" RIDGELOC_PROGRAM "' ";

}  // namespace

TEST_CASE("a run whose messages nobody can take ends as any other") {
  const WithStudy folder(study);
  REQUIRE(folder.ridgeloc("run s.toml -o whole.h5").exit_code == 0);
  const std::string digest = results::data_digest(folder.path() / "whole.h5");
  const std::string error = GENERATE("2> /dev/full", "2>&-", "2> >(true)", "< /dev/null 0<&- 2>&-");
  INFO(error);
  // The study runs twice: once for the messages of an ordinary run, and once with more of them.
  folder.write("script.sh", "sleep 0.1; " + program + "run s.toml --trials 500 -o r.h5 " + error + " && " + program +
                                "run s.toml -o r.h5 " + error);
  const Outcome outcome = folder.shell("bash script.sh");
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == "r.h5\nr.h5\n");
  CHECK(results::data_digest(folder.path() / "r.h5") == digest);
}

TEST_CASE("progress that cannot be shown ends nothing") {
  const WithStudy folder(study);
  // A line of progress comes every ten seconds where there is no terminal.
  const Outcome outcome = folder.shell(program + "run s.toml --trials 1e10 --threads 1 --time-limit 11s 2> /dev/full");
  CHECK(outcome.exit_code == 4);
  CHECK(folder.has("s.h5.parts"));
}

TEST_CASE("a closed standard output or error is not taken by a file") {
  const WithStudy folder(study);
  const std::string closed = GENERATE(">&-", "2>&-", ">&- 2>&-", "<&- >&- 2>&-");
  INFO(closed);
  const Outcome run = folder.shell(program + "run s.toml " + closed);
  // Where the name of the result could not be printed that is said, if it can be, and the result is there.
  CHECK(run.exit_code == (closed[0] == '2' ? 0 : 3));
  CHECK(folder.ridgeloc("verify --blocks 0 s.h5").exit_code == 0);
}

TEST_CASE("studies after one whose name could not be printed run too") {
  const WithStudy folder(study);
  folder.write("t.toml", study);
  for (const char* reader : {"> /dev/full", "| true"}) {
    const Outcome outcome =
        folder.shell("{ sleep 0.3; " + program + "run s.toml t.toml -o out; echo $? > code; } " + reader);
    INFO(reader << outcome.error);
    CHECK(folder.read("code") == "3\n");
    CHECK(folder.ridgeloc("verify --blocks 0 out/s.h5").exit_code == 0);
    CHECK(folder.ridgeloc("verify --blocks 0 out/t.h5").exit_code == 0);
    REQUIRE(folder.shell("rm -r out").exit_code == 0);
  }
}

TEST_CASE("a reader that has seen enough ends a verb without a word; a full disk is told") {
  const WithStudy folder(study);
  REQUIRE(folder.ridgeloc("run s.toml --trials 5000").exit_code == 0);
  for (const char* verb : {"list", "summary s.h5", "export --trials s.h5", "--help"}) {
    INFO(verb);
    const Outcome gone = folder.shell("{ sleep 0.3; " + program + verb + "; echo $? > code; } | true");
    CHECK(gone.error.empty());
    CHECK(folder.read("code") == "3\n");
    const Outcome full = folder.shell(program + verb + " > /dev/full");
    CHECK(full.exit_code == 3);
    CHECK(line_count(full.error) == 1);
  }
}

TEST_CASE("a mistake has its exit code where it cannot be told") {
  const WithStudy folder(study);
  for (const char* error : {"2>&-", "2> /dev/full"})
    for (const char* verb : {"summary missing.h5", "run missing.toml", "lst", "run s.toml --trials none"})
      CHECK(folder.shell(program + verb + " " + error).exit_code == 2);
}

TEST_CASE("a terminal that goes away stops a run and keeps what is finished; under nohup it runs on") {
  const WithStudy folder(study);
  const std::string wait_for_part =
      "run=$!; until ls s.h5.parts/part-*.h5 > nothing 2>&1; do sleep 0.1; done; kill -HUP $run; ";
  const Outcome stopped = folder.shell(program + "run s.toml --trials 1e10 & " + wait_for_part + "wait $run");
  CHECK(stopped.exit_code == 4);
  CHECK(contains(stopped.error, "The same command goes on from there."));
  REQUIRE(folder.shell("rm -r s.h5.parts").exit_code == 0);
  const Outcome on = folder.shell("nohup " + program + "run s.toml --trials 1e10 > log 2>&1 & " + wait_for_part +
                                  "sleep 1.5; kill -TERM $run; wait $run");
  CHECK(on.exit_code == 4);
}
