#include "app/duration.hpp"

#include <string>

#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;
using namespace ridgeloc::app;

TEST_CASE("durations are told in the unit that reads best, however long") {
  CHECK(duration_text(0.418) == "0.42 s");
  CHECK(duration_text(12.3) == "12 s");
  CHECK(duration_text(200.0) == "3 min 20 s");
  CHECK(duration_text(7500.0) == "2 h 5 min");
  CHECK(duration_text(9.5 * 86400.0) == "9.5 days");
  CHECK(duration_text(2076.0 * 365.25 * 86400.0) == "2076 years");
  CHECK(duration_text(1e12) == "31688 years");
}

TEST_CASE("a time that is none is refused, and not echoed beyond what tells it") {
  const std::string digits(400, '7');
  const std::string message = tests::refusal_of([&] { static_cast<void>(seconds_of(digits)); });
  CHECK(tests::lacking(message, {"777...", "is not a time; write it as 90s"}) == "");
  CHECK(message.size() < 160);
  CHECK(seconds_of("1h30m") == 5400.0);
}
