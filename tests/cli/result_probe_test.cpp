#include "app/result_probe.hpp"

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
