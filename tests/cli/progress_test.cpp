#include "app/progress.hpp"

#include <string>

#include "tests/support/catch.hpp"
#include "tests/support/contains.hpp"

using namespace ridgeloc;
using tests::contains;

TEST_CASE("what a run shows of itself is how far it is, and that it writes when all is done") {
  studies::RunProgress progress;
  progress.trials_total = 1000;
  progress.trials_done = 200;
  progress.trials_found = 50;
  CHECK(contains(app::progress_text("s", progress, false, 1.0, false), "s: 25.0 %, "));
  CHECK(contains(app::progress_text("s", progress, false, 1.0, true), " 25% [######"));
  progress.trials_done = 950;
  CHECK(app::progress_text("s", progress, false, 1.0, true) == "s: all trials are done, writing the result");
}

TEST_CASE("between two rounds of a stop rule all trials that are known are done, and nothing is written yet") {
  studies::RunProgress progress;
  progress.trials_total = 1000;
  progress.trials_done = 1000;
  CHECK(contains(app::progress_text("s", progress, true, 1.0, false), "s: 100.0 %, "));
  progress.is_writing = true;
  CHECK(app::progress_text("s", progress, true, 1.0, false) == "s: all trials are done, writing the result");
}
