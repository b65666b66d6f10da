#include "app/result_probe.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <stdexcept>
#include <vector>

#include "core/error.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;
using namespace ridgeloc::app;

namespace {

std::string complaint_of(const std::string& path, const std::function<void()>& read) {
  return tests::refusal_of([&] { probe(path, read); });
}

}  // namespace

TEST_CASE("a reader that crashes, asks for too much memory or does not end is found out in another process") {
  const tests::WorkingFolder folder;
  folder.write("x.h5", "some bytes");
  const std::string path = (folder.path() / "x.h5").string();
  const std::string refused = path + " is damaged: reading it fails; compute it again or restore it from a copy";
  CHECK(complaint_of(path, [] { std::raise(SIGKILL); }) == refused);
  CHECK(complaint_of(path, [] { throw std::length_error("of a vector"); }) == refused);
  CHECK(complaint_of(path, [] { std::vector<char>(std::size_t{3} << 30); }) == refused);
  volatile bool for_ever = true;
  CHECK(complaint_of(path, [&] {
          while (for_ever) {
          }
        }) == refused);
}

TEST_CASE("a reader that waits for ever is ended, and a lack of memory is not called damage") {
  const tests::WorkingFolder folder;
  folder.write("x.h5", "some bytes");
  const std::string path = (folder.path() / "x.h5").string();
  const auto waits = [] {
    for (;;) pause();
  };
  CHECK(tests::message_of<core::IoError>([&] { probe(path, waits, 0.2); }) ==
        path + ": reading it has not ended within 1 s; is its disk or network out of reach?");
  // In a process of its own, since no limit can be raised again.
  const pid_t child = fork();
  if (child == 0) {
    const rlimit little{rlim_t{900} << 20, rlim_t{900} << 20};
    setrlimit(RLIMIT_AS, &little);
    const std::string message =
        tests::message_of<core::IoError>([&] { probe(path, [] { std::vector<char>(std::size_t{1} << 30); }); });
    _exit(tests::lacking(message, {path, "no more than 900 MiB of memory are allowed", "ulimit -v"}).empty() ? 0 : 1);
  }
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  CHECK(status == 0);
}

TEST_CASE("a reader that works, or says what is wrong, is left to do so") {
  const tests::WorkingFolder folder;
  folder.write("x.h5", "some bytes");
  const std::string path = (folder.path() / "x.h5").string();
  CHECK(complaint_of(path, [] {}) == "");
  CHECK(complaint_of(path, [] { throw core::InputError("not HDF5"); }) == "");
  CHECK(complaint_of(path, [] { throw core::IoError("cannot be read"); }) == "");
  CHECK(complaint_of("missing.h5", [] { std::vector<char>(std::size_t{1} << 29); }) == "");
  int calls = 0;
  CHECK(read_probed(path, [&] { return ++calls; }) == 1);  // the other call was in the other process
  std::signal(SIGCHLD, SIG_IGN);
  CHECK(complaint_of(path, [] { std::raise(SIGKILL); }) != "");
}
