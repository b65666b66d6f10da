#include <algorithm>

#include "results/store/result_file.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

const std::string small = R"(experiment = "ranging"
trials = 9000
[sweep]
points = [3, 5]
[[method]]
solver = "rrr"
[[method]]
solver = "ols"
)";

struct WithSmallStudy : WithStudy {
  WithSmallStudy() : WithStudy(small) {}

  std::string digest(const std::string& file) const { return results::data_digest(path() / file); }
};

}  // namespace

TEST_CASE("raising --trials tops a result up; lowering it keeps the surplus and says so") {
  const WithSmallStudy folder;
  REQUIRE(folder.ridgeloc("run s.toml -o whole.h5").exit_code == 0);
  REQUIRE(folder.ridgeloc("run s.toml --trials 100").exit_code == 0);
  const Outcome raised = folder.ridgeloc("run s.toml");
  CHECK(raised.exit_code == 0);
  CHECK(folder.digest("s.h5") == folder.digest("whole.h5"));
  const Outcome lowered = folder.ridgeloc("run s.toml --trials 100");
  CHECK(lowered.exit_code == 0);
  CHECK(contains(lowered.error, "asked for 9000 trials per cell before; all stay"));
  CHECK(contains(lowered.error, "complete already"));
  CHECK(folder.digest("s.h5") == folder.digest("whole.h5"));
}

TEST_CASE("a narrower study adds to a result what it lacks and loses nothing of it") {
  const WithSmallStudy folder;
  REQUIRE(folder.ridgeloc("run s.toml").exit_code == 0);
  const std::string lm = "--set sweep.points=[4,5] --set method.1.solver=lm";
  const Outcome other = folder.ridgeloc("run s.toml " + lm);
  CHECK(other.exit_code == 0);
  CHECK(contains(other.error, "has 1 cell and 1 method besides what was asked for; they stay"));
  REQUIRE(folder.ridgeloc("run s.toml -o alone.h5").exit_code == 0);
  CHECK(contains(folder.ridgeloc("run s.toml -o alone.h5 --set sweep.points=[3]").error,
                 "alone.h5: has 1 cell besides what was asked for; it stays"));
  const Outcome verified = folder.ridgeloc("verify s.h5 --blocks 100");
  CHECK(verified.exit_code == 0);
  CHECK(contains(verified.out, "incomplete: 2 of 3 cells"));  // lm with 3 points, ols with 4
  // The whole of both studies has what is missing.
  REQUIRE(folder.ridgeloc("export s.h5 --study -o all.toml").exit_code == 0);
  CHECK(folder.ridgeloc("run all.toml -o s.h5").exit_code == 0);
  CHECK(folder.ridgeloc("run all.toml -o fresh.h5").exit_code == 0);
  CHECK(folder.digest("s.h5") == folder.digest("fresh.h5"));
}

TEST_CASE("a result goes through a link to where the link points, and so do its parts") {
  const WithSmallStudy folder;
  REQUIRE(folder.shell("mkdir disk && ln -s disk/r.h5 r.h5").exit_code == 0);
  CHECK(folder.ridgeloc("run s.toml --trials 1e9 --time-limit 1s -o r.h5").exit_code == 4);
  CHECK(folder.has("disk/r.h5.parts"));
  CHECK(folder.ridgeloc("run s.toml --trials 100 -o r.h5").exit_code == 0);
  CHECK(folder.ridgeloc("run s.toml --trials 5000 -o r.h5").exit_code == 0);
  CHECK(folder.shell("test -L r.h5 && test -f disk/r.h5").exit_code == 0);
  CHECK_FALSE(folder.has("r.h5.parts"));
}

TEST_CASE("a method whose settings have changed needs another name") {
  const WithSmallStudy folder;
  REQUIRE(folder.ridgeloc("run s.toml").exit_code == 0);
  const Outcome outcome = folder.ridgeloc("run s.toml --set method.0.k=hk");
  CHECK(outcome.exit_code == 2);
  CHECK(line_count(outcome.error) == 1);
  CHECK(contains(outcome.error, "method \"rrr\" has other settings"));
  CHECK(folder.ridgeloc("run s.toml --set method.0.k=hk --set method.0.name=hk").exit_code == 0);
}

TEST_CASE("shares are merged to the whole; parts of it are results too") {
  const WithSmallStudy folder;
  REQUIRE(folder.ridgeloc("run s.toml").exit_code == 0);
  for (const char* share : {"1/3", "2/3", "3/3"})
    REQUIRE(folder.ridgeloc(std::string("run s.toml --shard ") + share).exit_code == 0);
  const Outcome merged =
      folder.ridgeloc("merge s.shard-2-of-3.h5 s.shard-3-of-3.h5 s.shard-1-of-3.h5 s.shard-2-of-3.h5 -o all.h5");
  CHECK(merged.exit_code == 0);
  CHECK(merged.out == "all.h5\n");
  CHECK(contains(merged.error, "complete: 2 cells"));
  CHECK(folder.digest("all.h5") == folder.digest("s.h5"));
  CHECK(contains(folder.ridgeloc("summary s.shard-1-of-3.h5").out, "incomplete: "));
  // Going on from a share computes the others.
  REQUIRE(folder.ridgeloc("run s.toml -o s.shard-1-of-3.h5").exit_code == 0);
  CHECK(folder.digest("s.shard-1-of-3.h5") == folder.digest("s.h5"));
}

TEST_CASE("audit solves the trials that a result has, and no others") {
  const WithSmallStudy folder;
  const auto trials = [&](const std::string& file) {
    return folder.shell("'" RIDGELOC_PROGRAM "' audit " + file + " | awk '/^  (rrr|ols)/ { print $1, $2 }'").out;
  };
  // Blocks of 4096, 4096 and 808 trials, of two cells, dealt to three shares.
  REQUIRE(folder.ridgeloc("run s.toml --shard 3/3 -o share.h5").exit_code == 0);
  CHECK(trials("share.h5") == "rrr 808\nols 808\nrrr 808\nols 808\n");
  folder.write("ols.toml", "experiment = \"ranging\"\n[sweep]\npoints = [3]\n[[method]]\nsolver = \"ols\"\n");
  REQUIRE(folder.ridgeloc("run ols.toml --trials 9000 -o grown.h5").exit_code == 0);
  REQUIRE(folder.ridgeloc("run s.toml --trials 100 -o grown.h5").exit_code == 0);
  CHECK(trials("grown.h5") == "rrr 100\nols 9000\nrrr 100\nols 100\n");
  CHECK(trials("grown.h5 --trials 5000") == "rrr 100\nols 5000\nrrr 100\nols 100\n");
}

TEST_CASE("merge refuses other studies, other instruction sets and a file that is there") {
  const WithSmallStudy folder;
  REQUIRE(folder.ridgeloc("run s.toml -o a.h5 --trials 100 --isa baseline").exit_code == 0);
  REQUIRE(
      folder.ridgeloc("run s.toml -o b.h5 --trials 100 --isa baseline --seed 9 --set scene.depth_m=[1,2]").exit_code ==
      0);
  const auto refused = [&](const std::string& arguments, const std::string& message) {
    const Outcome outcome = folder.ridgeloc("merge " + arguments);
    INFO(outcome.error);
    CHECK(outcome.exit_code == 2);
    CHECK(line_count(outcome.error) == 1);
    CHECK(contains(outcome.error, message));
  };
  refused("a.h5 b.h5 -o c.h5", "seed is ");
  refused("a.h5 b.h5 -o c.h5", "depth_m is ");
  refused("a.h5 -o a.h5", "a.h5 exists");
  refused("a.h5 s.toml -o c.h5", "s.toml is not an HDF5 file");
  refused("a.h5 -o nowhere/c.h5", "nowhere");
  refused("a.h5 b.h5 -o c.h5", " and cannot be merged with ");
  refused("a.h5", "-o");
  CHECK_FALSE(folder.has("c.h5"));
}

TEST_CASE("a result of several instruction sets says why it cannot be computed again or continued") {
  const WithSmallStudy folder;
  for (const char* share : {"1/2 --isa baseline -o a.h5", "2/2 -o b.h5"})
    REQUIRE(folder.ridgeloc(std::string("run s.toml --shard ") + share).exit_code == 0);
  if (folder.ridgeloc("merge a.h5 b.h5 -o s.h5").exit_code == 0) return;  // this processor has the baseline alone
  REQUIRE(folder.ridgeloc("merge a.h5 b.h5 -o s.h5 --mix-isa").exit_code == 0);
  CHECK(folder.ridgeloc("verify s.h5 --blocks 0").exit_code == 0);
  for (const char* verb :
       {"verify s.h5", "run s.toml", "run s.toml --isa baseline", "audit s.h5", "replay s.h5 --cell 0 --trial 0"}) {
    const Outcome outcome = folder.ridgeloc(verb);
    INFO(verb << ": " << outcome.error);
    CHECK(outcome.exit_code == 2);
    CHECK(line_count(outcome.error) == 1);
    CHECK(contains(outcome.error, "was merged from results of several instruction sets"));
  }
}

TEST_CASE("a stopped run counts all blocks that are kept, not only those that it came across") {
  const WithSmallStudy folder;
  const auto kept = [&](const std::string& threads) {
    const std::string error = folder.ridgeloc("run s.toml --trials 1e9 --time-limit 1s --threads " + threads).error;
    INFO(error);
    const std::size_t place = error.find("stopped; ");
    REQUIRE(place != std::string::npos);
    CHECK(contains(error, " are kept in s.h5.parts."));
    return std::stoull(error.substr(place + 9));
  };
  const auto first = kept("2");
  // Two threads begin at two places; one thread alone does not come to the second of them.
  CHECK(kept("1") > first);
}

TEST_CASE("a time limit and SIGUSR1 stop a run and keep what is finished") {
  const WithSmallStudy folder;
  const Outcome limited = folder.ridgeloc("run s.toml --trials 1e10 --time-limit 1s");
  CHECK(limited.exit_code == 4);
  CHECK(contains(limited.error, "The same command goes on from there"));
  CHECK(folder.has("s.h5.parts"));
  // Fewer trials are enough after all; what is there beyond them stays.
  CHECK(folder.ridgeloc("run s.toml --trials 5000").exit_code == 0);
  CHECK(contains(folder.ridgeloc("verify s.h5").out, "complete: 2 cells with 5000 to "));
  const Outcome signalled = folder.shell("timeout -s USR1 -k 20 1 '" RIDGELOC_PROGRAM "' run s.toml --trials 1e10");
  CHECK(signalled.exit_code == 124);  // timeout's own
  CHECK(contains(signalled.error, "stopped;"));
  for (const std::string& bad : {std::string("0"), std::string("soon"), std::string("1x"), std::string("-5"),
                                 std::string("1:2:3:4"), std::string(400, '9'), std::string(100'000, '9')}) {
    const Outcome outcome = folder.ridgeloc("run s.toml -o x/ --time-limit=" + bad);
    CHECK(outcome.exit_code == 2);
    CHECK(line_count(outcome.error) == 1);
  }
  for (const char* bad : {"0/3", "4/3", "1", "1/", "/2", "a/b", "1/2/3"}) {
    const Outcome outcome = folder.ridgeloc(std::string("run s.toml -o x.h5 --shard ") + bad);
    CHECK(outcome.exit_code == 2);
    CHECK(contains(outcome.error, "i/N"));
  }
  CHECK_FALSE(folder.has("x"));
  CHECK_FALSE(folder.has("x.h5"));
}

TEST_CASE("verify recomputes blocks, tells a result of other numbers, and prints the digest") {
  const WithSmallStudy folder;
  REQUIRE(folder.ridgeloc("run s.toml").exit_code == 0);
  const Outcome good = folder.ridgeloc("verify s.h5 --blocks 4 --seed 1");
  CHECK(good.exit_code == 0);
  CHECK(contains(good.out, "complete: 2 cells with 9000 trials each"));
  CHECK(contains(good.out, "4 of 6 computed again"));
  CHECK(contains(folder.ridgeloc("verify s.h5 --blocks 1000000000000").out, "6 of 6 computed again"));
  CHECK(folder.ridgeloc("verify s.h5 --digest --blocks 2").exit_code == 2);
  CHECK(folder.ridgeloc("verify s.h5 --digest --seed 2").exit_code == 2);
  CHECK(folder.ridgeloc("verify s.h5 --digest").out == folder.digest("s.h5") + "\n");

  const Outcome listed = folder.ridgeloc("export s.h5 --failures");
  CHECK(listed.exit_code == 0);
  CHECK(listed.out.starts_with("points,trial,method,reason\n"));
  CHECK(folder.ridgeloc("export s.h5 --failures --trials").exit_code == 2);
  CHECK(folder.ridgeloc("export s.h5 --study --csv").exit_code == 2);
  CHECK(folder.ridgeloc("verify s.toml").exit_code == 2);
  CHECK(folder.ridgeloc("verify missing.h5").exit_code == 2);
}

TEST_CASE("compare says whether two results of one study agree") {
  const WithSmallStudy folder;
  for (const char* run : {"-o a.h5", "-o b.h5 --seed 7", "-o c.h5 --set scene.depth_m=[1,2]", "-o d.h5 --threads 1"})
    REQUIRE(folder.ridgeloc(std::string("run s.toml ") + run).exit_code == 0);
  const Outcome other_seed = folder.ridgeloc("compare a.h5 b.h5");
  CHECK(other_seed.exit_code == 0);
  CHECK(contains(other_seed.out, "agree: "));
  const Outcome same = folder.ridgeloc("compare a.h5 d.h5");
  CHECK(same.exit_code == 0);
  CHECK(contains(same.out, "equal: both hold the same numbers, bit for bit"));
  const Outcome other = folder.ridgeloc("compare a.h5 c.h5");
  CHECK(other.exit_code == 2);
  CHECK(line_count(other.error) == 1);
  CHECK(contains(other.error, "depth_m is [1.0, 10.0], not [1.0, 2.0]"));
}

TEST_CASE("a study that waits for its turn keeps what another run has made of its result meanwhile") {
  const WithSmallStudy folder;
  const auto with_trials = [](const std::string& trials) {
    return small.substr(0, small.find("9000")) + trials + small.substr(small.find("9000") + 4);
  };
  folder.write("slow.toml", with_trials("500000"));
  folder.write("s.toml", with_trials("300"));
  // The run of both is halted at the first one while another run makes the result of the second.
  const Outcome outcome = folder.shell(
      "'" RIDGELOC_PROGRAM
      "' run slow.toml s.toml -o . --threads 1 > both 2> both.err & both=$!; "
      "until ls slow.h5.parts > nothing 2>&1; do :; done; kill -STOP $both; "
      "'" RIDGELOC_PROGRAM "' run s.toml --trials 5000; code=$?; kill -CONT $both; wait $both && exit $code");
  INFO(outcome.error << folder.read("both.err"));
  REQUIRE(outcome.exit_code == 0);
  CHECK(results::read_result_header(folder.path() / "s.h5").trials == 5000);
  CHECK(contains(folder.ridgeloc("verify --blocks 0 s.h5").out, "complete: 2 cells with 5000 trials each"));
  CHECK(contains(folder.read("both.err"), "s.h5: was asked for 5000 trials per cell before; all stay"));
}
