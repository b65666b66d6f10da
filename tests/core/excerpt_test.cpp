#include "core/excerpt.hpp"

#include <string>

#include "tests/support/catch.hpp"

using ridgeloc::core::excerpt;

TEST_CASE("texts are echoed whole up to 60 bytes, and cut between characters") {
  CHECK(excerpt("") == "");
  CHECK(excerpt(std::string(60, 'a')) == std::string(60, 'a'));
  CHECK(excerpt(std::string(400, 'a')) == std::string(60, 'a') + "...");
  CHECK(excerpt(std::string(59, 'a') + "µm") == std::string(59, 'a') + "...");
  CHECK(excerpt(std::string(58, 'a') + "µm") == std::string(58, 'a') + "µ...");
}

TEST_CASE("texts are echoed in one line, without what a terminal takes for a command") {
  CHECK(excerpt("a\n\tb\x1b") == "a  b?");
}
