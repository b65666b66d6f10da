#include "results/pictures/gnuplot.hpp"

#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "tests/support/catch.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;

TEST_CASE("strings are quoted so that gnuplot changes nothing in them") {
  CHECK(gnuplot_string("it's `date` \\n \"x\" @y") == "'it''s `date` \\n \"x\" @y'");
  CHECK(gnuplot_string("two\nlines\tand a tab") == "'two lines and a tab'");
  CHECK(gnuplot_tick_label("5%") == "'5%%'");
}

TEST_CASE("a script that fails is an I/O error with gnuplot's message on one line") {
  try {
    run_gnuplot("set terminal dumb\nplot nonsense(x)\n");
    FAIL("no error");
  } catch (const core::IoError& error) {
    const std::string message = error.what();
    CHECK(message.find("gnuplot failed: ") == 0);
    CHECK(message.find("undefined function: nonsense") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
}

TEST_CASE("a script that works is silent") {
  CHECK_NOTHROW(run_gnuplot("x = 1\n"));
}

TEST_CASE("without gnuplot the message names the package") {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  std::string message;
  try {
    run_gnuplot("x = 1\n");
  } catch (const core::InputError& error) {
    message = error.what();
  }
  setenv("PATH", path.c_str(), 1);
  CHECK(message.find("gnuplot-nox") != std::string::npos);
}

}  // namespace
