#include "core/printable.hpp"

#include "tests/support/catch.hpp"

using namespace ridgeloc::core;

TEST_CASE("a text loses what a terminal takes for a command, and nothing else") {
  CHECK(printable("µ and σ,\n\ttwo lines: \"'`$\\") == "µ and σ,\n\ttwo lines: \"'`$\\");
  CHECK(printable("\x1b]0;title\x07") == "?]0;title?");
  CHECK(printable(std::string("a\0b\r\x7f", 5)) == "a?b??");
  CHECK(printable("\xc2\x9b"
                  "31m\xc2\xa0\xc2") == "?31m\xc2\xa0\xc2");
  CHECK(printable("").empty());
}
