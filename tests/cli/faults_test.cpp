// What goes wrong with the machine during a run: one line, an exit code, and everything finished stays.

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <regex>

#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

namespace {

const std::string study = R"(experiment = "ranging"
trials = 60000
audit = 0
[store]
trial_columns_mib = 1024
[sweep]
points = [3, 5]
[[method]]
solver = "ols"
[[method]]
solver = "linear"
)";

/// Waits until a run says how far it is.
const std::string until_begun = "until ls s.h5.parts/run.txt > nothing 2>&1; do sleep 0.05; done; ";

/// A folder `disk` with a file system of its own, which the commands of one script see. Needs no rights where users
/// may have their own name spaces.
Outcome on_own_disk(const WorkingFolder& folder, const std::string& size, const std::string& script) {
  folder.write("script.sh", "set -e\nmkdir disk\nmount -t tmpfs -o size=" + size + " none disk\n" +
                                "ridgeloc() { '" RIDGELOC_PROGRAM "' \"$@\"; }\nset +e\n" + script);
  return folder.shell("unshare --map-root-user --mount sh script.sh");
}

/// The beginning of a call of the program where the file system cannot do something, and says so by an error.
std::string on_odd_file_system(const std::string& what, int error) {
  // Where the program brings a sanitizer it must be told that another library comes first.
  return "ASAN_OPTIONS=verify_asan_link_order=0 " + what + "=" + std::to_string(error) +
         " LD_PRELOAD='" ODD_FILE_SYSTEM "' '" RIDGELOC_PROGRAM "' ";
}

bool has_own_disks() {
  const WorkingFolder folder;
  return on_own_disk(folder, "1m", "true").exit_code == 0;
}

#define REQUIRE_OWN_DISKS()                                                                              \
  if (!has_own_disks()) {                                                                                \
    WARN("skipped: this user may not mount a file system in a name space of its own (unshare --mount)"); \
    return;                                                                                              \
  }

}  // namespace

// 60000 trials of the study are 15 MB as parts and 13 as a result, so that a disk with less room is refused and one
// with room for the parts alone fails the result.

TEST_CASE("a disk without room for the result is found before anything is computed") {
  REQUIRE_OWN_DISKS();
  const WithStudy folder(study);
  const Outcome outcome = on_own_disk(folder, "60m", R"(
head -c 59M /dev/zero > disk/ballast
ridgeloc run s.toml -o disk/s.h5; echo $?
ls disk
ridgeloc run s.toml --set store.trial_columns_mib=0 -o disk/s.h5; echo $?
ridgeloc run s.toml --set store.trial_columns_mib=0 -o disk/s.h5; echo $?
)");
  INFO(outcome.out << outcome.error);
  CHECK(outcome.out == "2\nballast\ndisk/s.h5\n0\ndisk/s.h5\n0\n");
  CHECK(contains(outcome.error, "disk/s.h5: takes about 1"));
  CHECK(contains(outcome.error, " are free; make room, keep fewer trials, or choose another -o\n"));
}

TEST_CASE("what is there already, and the shares of others, need no room") {
  REQUIRE_OWN_DISKS();
  const WithStudy folder(study);
  const Outcome outcome = on_own_disk(folder, "60m", R"(
ridgeloc run s.toml --trials 8192 -o disk/r.h5 2> first; echo $?
ridgeloc run s.toml -o disk/s.h5 2> first; echo $?
head -c 100M /dev/zero > disk/ballast 2> full
dd if=/dev/null of=disk/ballast bs=1M seek=$(($(stat -c %s disk/ballast) / 1048576 - 4)) 2> cut
ridgeloc run s.toml -o disk/s.h5 2> again; echo $?
ridgeloc run s.toml --shard 1/8 -o disk/share.h5 2> share; echo $?
rm disk/share.h5
ridgeloc run s.toml -o disk/r.h5 2> more; echo $?
)");
  INFO(outcome.out << outcome.error << folder.read("again") << folder.read("share") << folder.read("more"));
  CHECK(outcome.out == "disk/r.h5\n0\ndisk/s.h5\n0\ndisk/s.h5\n0\ndisk/share.h5\n0\n2\n");
  CHECK(folder.read("again") == "disk/s.h5: complete already, nothing to do\n");
  CHECK(contains(folder.read("more"), "disk/r.h5: takes about 1"));
  CHECK(contains(folder.read("more"), " MiB more, "));
}

TEST_CASE("the digests of blocks need room too") {
  REQUIRE_OWN_DISKS();
  const WithStudy folder(study);
  // 10^10 trials are 2.4 million blocks in each of two cells, of two solvers, the scene and a difference.
  const Outcome outcome = on_own_disk(folder, "60m", R"(
ridgeloc run s.toml --trials 1e10 --set store.trial_columns_mib=0 -o disk/s.h5; echo $?
)");
  INFO(outcome.out << outcome.error);
  CHECK(outcome.out == "2\n");
  CHECK(contains(outcome.error, "disk/s.h5: takes about 149 MiB, 0 KiB of it values"));
}

TEST_CASE("with a stop rule the most trials need room, but not those of cells that are known well enough") {
  REQUIRE_OWN_DISKS();
  const WithStudy folder(study + R"([stop]
metric = "iterations"
methods = ["ols"]
relative = 0.01
min_trials = 4096
max_trials = 1000000
)");
  // All trials of both cells would be 250 MB, those that the rule asks for are 2.
  const Outcome outcome = on_own_disk(folder, "60m", R"(
ridgeloc run s.toml -o disk/s.h5; echo $?
ridgeloc run s.toml --set store.trial_columns_mib=1 -o disk/s.h5 2> narrow; echo $?
ridgeloc run s.toml --set store.trial_columns_mib=1 --set stop.relative=0.009 -o disk/s.h5 2> again; echo $?
ridgeloc run s.toml --set stop.max_cost=1e5 -o disk/cost.h5 2> cost; echo $?
)");
  INFO(outcome.out << outcome.error << folder.read("narrow") << folder.read("again") << folder.read("cost"));
  CHECK(outcome.out == "2\ndisk/s.h5\n0\ndisk/s.h5\n0\ndisk/cost.h5\n0\n");
  CHECK(contains(outcome.error, "disk/s.h5: takes about 2"));
}

TEST_CASE("a plan writes a bounded amount to find out what writing costs") {
  REQUIRE_OWN_DISKS();
  const WithStudy folder(study);
  const Outcome outcome = on_own_disk(folder, "90m", R"(
TMPDIR=disk ridgeloc plan s.toml --trials 1e7 --set store.trial_columns_mib=4000
)");
  INFO(outcome.out << outcome.error);
  CHECK(outcome.exit_code == 0);
  CHECK(contains(outcome.out, "  disk     about "));
  CHECK_FALSE(contains(outcome.out, "not reckoned"));
}

TEST_CASE("a disk that is too full for the result is one line and exit code 3, and the same command goes on") {
  REQUIRE_OWN_DISKS();
  const WithStudy folder(study);
  const Outcome outcome = on_own_disk(folder, "60m", R"(
head -c 40M /dev/zero > disk/ballast
ridgeloc run s.toml -o disk/s.h5; echo $?
ls disk
rm disk/ballast
ridgeloc run s.toml -o disk/s.h5 2> again; echo $?
ls disk
ridgeloc verify --digest disk/s.h5
ridgeloc run s.toml -o whole.h5 2> whole
ridgeloc verify --digest whole.h5
)");
  INFO(outcome.out << outcome.error << folder.read("again"));
  CHECK(line_count(outcome.error) == 2);
  CHECK(contains(outcome.error, "warning: disk/s.h5: takes about 1"));
  CHECK(std::regex_search(
      outcome.error,
      std::regex(" 1.* MiB in parts before that, and [0-9.]+ MiB are free; both are there for a while ")));
  CHECK(contains(outcome.error,
                 ": No space left on device (finished parts are kept in disk/s.h5.parts; the same command "
                 "goes on from there)"));
  const std::string digest = folder.ridgeloc("verify --digest whole.h5").out;
  CHECK(outcome.out == "3\nballast\ns.h5.parts\ndisk/s.h5\n0\ns.h5\n" + digest + "whole.h5\n" + digest);
  CHECK(contains(folder.read("again"), "30 of 30 blocks were there"));
}

TEST_CASE("a disk that others fill during a run is one line and exit code 3, and the run begins anew") {
  REQUIRE_OWN_DISKS();
  const WithStudy folder(study);
  // The first part is written after 5 s.
  const Outcome outcome = on_own_disk(folder, "60m", R"(
ridgeloc run s.toml --trials 1e9 --set store.trial_columns_mib=1 -o disk/s.h5 2> error &
run=$!
until ls disk/s.h5.parts > nothing_yet 2>&1; do sleep 0.1; done
head -c 100M /dev/zero > disk/ballast 2> full
wait $run; echo $?
grep -v "trials/s" error >&2
rm disk/ballast
ridgeloc run s.toml --trials 1000 -o disk/s.h5; echo $?
)");
  INFO(outcome.out << outcome.error);
  CHECK(contains(outcome.error, "No space left on device (the same command goes on from there)\n"));
  CHECK(outcome.out == "3\ndisk/s.h5\n0\n");
}

TEST_CASE("a disk that cannot be written is found before anything is computed; reading from it works") {
  REQUIRE_OWN_DISKS();
  const WithStudy folder(study);
  const Outcome outcome = on_own_disk(folder, "60m", R"(
ridgeloc run s.toml --trials 100 -o disk/s.h5 2> first
mount -o remount,ro disk
ridgeloc run s.toml -o disk/s.h5; echo $?
ridgeloc export disk/s.h5 -o disk/s.csv; echo $?
ridgeloc verify --blocks 1 disk/s.h5 > verified; echo $?
)");
  INFO(outcome.out << outcome.error);
  CHECK(outcome.out == "disk/s.h5\n2\n2\n0\n");
  CHECK(line_count(outcome.error) == 2);
  CHECK(contains(outcome.error, "cannot write disk/s.h5: Read-only file system"));
  CHECK(contains(outcome.error, "cannot write disk/s.csv: Read-only file system"));
}

TEST_CASE("a disk that becomes read-only during a run is one line and exit code 3") {
  REQUIRE_OWN_DISKS();
  const WithStudy folder(study);
  // The new state is refused while a file is open for writing, and for writing a part the run must go on for 5 s.
  const Outcome outcome = on_own_disk(folder, "60m", R"(
ridgeloc run s.toml --trials 1e9 --set store.trial_columns_mib=1 -o disk/s.h5 2> error &
run=$!
until ls disk/s.h5.parts/part-000000.h5 2> nothing_yet; do sleep 0.1; done
until mount -o remount,ro disk 2> busy; do sleep 0.1; done
wait $run; echo $?
grep -v "trials/s\|keeps the values" error >&2
ls disk disk/s.h5.parts
)");
  INFO(outcome.out << outcome.error);
  CHECK(line_count(outcome.error) == 1);
  CHECK(contains(outcome.error, "Read-only file system (finished parts are kept in disk/s.h5.parts; the same command"));
  CHECK(contains(outcome.out, "part-000000.h5\n3\ndisk:\ns.h5.parts\n"));
}

TEST_CASE("a folder that vanishes during a run is one line and exit code 3, and the same command begins anew") {
  const WithStudy folder(study);
  const std::string vanishing = GENERATE("out", "out/s.h5.parts");
  const Outcome outcome = folder.shell("mkdir out; '" RIDGELOC_PROGRAM
                                       "' run s.toml -o out/s.h5 & run=$!; "
                                       "until ls out/s.h5.parts/run.txt > nothing 2>&1; do :; done; rm -r " +
                                       vanishing + "; wait $run");
  INFO(outcome.error);
  CHECK(outcome.exit_code == 3);
  CHECK(line_count(outcome.error) == 1);
  CHECK(contains(outcome.error, "s.h5"));
  CHECK(contains(outcome.error, "(the same command goes on from there)"));
  CHECK_FALSE(folder.has("out/s.h5"));
  REQUIRE(folder.shell("mkdir -p out").exit_code == 0);
  CHECK(folder.ridgeloc("run s.toml -o out/s.h5").exit_code == 0);
}

TEST_CASE("a file-size limit that parts keep and the result exceeds leaves the parts") {
  const WithStudy folder(study);
  // In units of 512 bytes. Stopping leaves a part, and neither it nor that of the rest is beyond the limit: the machine
  // may be busy, so that another pause is tried until the part has such a size.
  const Outcome stopped =
      folder.shell("for pause in 0.05 0.02 0.08 0.12 0.2 0.3 0.5 1; do rm -rf s.h5 s.h5.parts; '" RIDGELOC_PROGRAM
                   "' run s.toml --threads 1 & run=$!; until ls s.h5.parts > nothing 2>&1; do :; done; sleep $pause; "
                   "kill -TERM $run; wait $run; size=$(du -sk s.h5.parts 2> nothing | cut -f1); "
                   "[ ${size:-0} -gt 3500 ] && [ $size -lt 11500 ] && exit 4; done; exit 1");
  REQUIRE(stopped.exit_code == 4);
  const Outcome limited = folder.shell("ulimit -f 24000 && '" RIDGELOC_PROGRAM "' run s.toml");
  INFO(limited.error);
  CHECK(limited.exit_code == 3);
  CHECK(line_count(limited.error) == 1);
  CHECK(contains(limited.error, "File too large (finished parts are kept in s.h5.parts; the same command goes on"));
  const Outcome again = folder.ridgeloc("run s.toml");
  CHECK(again.exit_code == 0);
  CHECK(contains(again.error, "30 of 30 blocks were there"));
}

TEST_CASE("a file system that cannot synchronize folders is written to all the same, and one that fails is not") {
  const WithStudy folder(study);
  const auto call = [&](int error, const std::string& arguments) {
    return folder.shell(on_odd_file_system("FOLDER_SYNC_ERROR", error) + arguments);
  };
  for (const int error : {EINVAL, EBADF, EOPNOTSUPP, ENOSYS}) {
    CHECK(call(error, "run s.toml --trials 500").exit_code == 0);
    CHECK(call(error, "new ranging -o n.toml").exit_code == 0);
    CHECK(call(error, "export s.h5 -o s.csv").exit_code == 0);
    REQUIRE(folder.shell("rm s.h5 n.toml s.csv").exit_code == 0);
  }
  const Outcome failed = call(EIO, "run s.toml --trials 500");
  CHECK(failed.exit_code == 3);
  CHECK(contains(failed.error, "cannot flush"));
}

TEST_CASE("runs are kept apart where nothing can be locked but what is open for writing, as on NFS") {
  const WithStudy folder(study);
  const std::string program = on_odd_file_system("READ_ONLY_LOCK_ERROR", EBADF);
  const Outcome outcome = folder.shell(program + "run s.toml --trials 1e10 2> first & run=$!; " + until_begun +
                                       program + "run s.toml; echo $?; kill -TERM $run; wait $run; echo $?");
  INFO(outcome.error);
  CHECK(outcome.out == "2\n4\n");
  CHECK(line_count(outcome.error) == 1);
  CHECK(contains(outcome.error, "another run is writing to s.h5.parts; wait for it"));
  CHECK_FALSE(contains(folder.read("first"), "no locks"));
}

TEST_CASE("where there are no locks that is said, and a second run is refused by what the first says of itself") {
  const WithStudy folder(study);
  const std::string program = on_odd_file_system("LOCK_ERROR", ENOLCK);
  const Outcome outcome = folder.shell(program + "run s.toml --trials 1e10 2> first & run=$!; " + until_begun +
                                       program + "run s.toml; echo $?; kill -TERM $run; wait $run; echo $?");
  INFO(outcome.error);
  CHECK(outcome.out == "2\n4\n");
  CHECK(line_count(outcome.error) == 1);
  CHECK(contains(outcome.error,
                 " is writing there, and this file system has no locks; wait for it, stop it, or choose another"));
  const std::string first = folder.read("first");
  INFO(first);
  CHECK(contains(first,
                 "warning: s.h5: this file system has no locks (No locks available); see to it that no other run"));
  CHECK(contains(first, "The same command goes on from there."));
  // Whoever was stopped is nobody to wait for.
  CHECK(folder.shell(program + "run s.toml --trials 1000").exit_code == 0);
}

TEST_CASE("where there are no locks a run that was killed a moment ago keeps nobody away") {
  const WithStudy folder(study);
  const std::string program = on_odd_file_system("LOCK_ERROR", ENOLCK);
  const Outcome outcome = folder.shell(program + "run s.toml --trials 1e10 2> first & run=$!; " + until_begun +
                                       "kill -KILL $run; wait $run; " + program + "run s.toml --trials 1000");
  INFO(outcome.error);
  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == "s.h5\n");
}

TEST_CASE("a lock that is another file each time is given up") {
  const WithStudy folder(study);
  const Outcome outcome = folder.shell("timeout 60 env " + on_odd_file_system("OTHER_LOCK_FILE", 1) + "run s.toml");
  CHECK(outcome.exit_code == 3);
  CHECK(outcome.error == "ridgeloc: cannot lock s.h5.parts/lock: it does not stay the same file\n");
}

TEST_CASE("where there are no locks a run that another one has come upon ends before it writes") {
  const WithStudy folder(study);
  const std::string program = on_odd_file_system("LOCK_ERROR", ENOLCK);
  const Outcome outcome = folder.shell(program + "run s.toml --trials 1e10 & run=$!; " + until_begun +
                                       "echo other > s.h5.parts/lock; wait $run");
  INFO(outcome.error);
  CHECK(outcome.exit_code == 3);
  CHECK(
      contains(outcome.error, "s.h5.parts was taken by another run meanwhile, which file locks would have kept away"));
  CHECK(folder.read("s.h5.parts/lock") == "other\n");
}

TEST_CASE("a locked result and too little memory are called what they are") {
  const WithStudy folder(study);
  REQUIRE(folder.ridgeloc("run s.toml --trials 500").exit_code == 0);
  const Outcome locked =
      folder.shell("flock -x s.h5 env HDF5_USE_FILE_LOCKING=TRUE '" RIDGELOC_PROGRAM "' summary s.h5");
  CHECK(locked.exit_code == 2);
  CHECK(locked.error ==
        "ridgeloc: s.h5 is locked by another program, which may be writing to it; close it there and try again\n");
  // Enough for the program to start, and too little to read anything.
  const Outcome limited = folder.shell("ulimit -v 60000 && '" RIDGELOC_PROGRAM "' summary s.h5");
  if (contains(limited.error, "shared object")) return;  // not even to start
  CHECK(limited.exit_code == 3);
  CHECK(line_count(limited.error) == 1);
  CHECK(contains(limited.error, "memory"));
  CHECK_FALSE(contains(limited.error, "damaged"));
}

TEST_CASE("links that lead in a circle are refused and stay") {
  const WithStudy folder(study);
  REQUIRE(folder.shell("ln -s b.h5 a.h5; ln -s a.h5 b.h5").exit_code == 0);
  const Outcome outcome = folder.ridgeloc("run s.toml --trials 500 -o a.h5");
  CHECK(outcome.exit_code == 2);
  CHECK(outcome.error == "ridgeloc: a.h5: these links lead in a circle; remove them or choose another -o\n");
  CHECK(folder.shell("test -h a.h5 && test -h b.h5").exit_code == 0);
}
