#include "results/pictures/gnuplot.hpp"

#include <cstdlib>
#include <string>

#include "core/error.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

namespace {

using namespace ridgeloc;
using namespace ridgeloc::results;

TEST_CASE("strings are quoted so that gnuplot changes nothing in them") {
  CHECK(gnuplot_string("it's") == R"("it\047s")");
  CHECK(gnuplot_string("0.12 1") == R"("0\056\061\062 1")");
  CHECK(gnuplot_string("`a` \\n \"x\" @y #z") == R"("\140a\140 \134n \042x\042 \100y \043z")");
  CHECK(gnuplot_string("two\nlines\tand a tab") == "\"two lines and a tab\"");
  CHECK(gnuplot_string("größe 12") == "\"größe 12\"");
  CHECK(gnuplot_tick_label("5%") == R"("5\045\045")");
}

TEST_CASE("a script that fails is an I/O error with gnuplot's message on one line") {
  const std::string message =
      tests::message_of<core::IoError>([] { run_gnuplot("set terminal dumb\nplot nonsense(x)\n"); });
  CHECK(message.find("gnuplot failed: ") == 0);
  CHECK(message.find("undefined function: nonsense") != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
}

TEST_CASE("a script that works is silent") {
  CHECK_NOTHROW(run_gnuplot("x = 1\n"));
}

TEST_CASE("without gnuplot the message names the package") {
  const std::string path = std::getenv("PATH");
  setenv("PATH", "/nonexistent", 1);
  const std::string message = tests::refusal_of([] { run_gnuplot("x = 1\n"); });
  setenv("PATH", path.c_str(), 1);
  CHECK(message.find("gnuplot-nox") != std::string::npos);
}

}  // namespace
