#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

TEST_CASE("a study inside a result names no file that is read") {
  const std::string samples = R"(experiment = "ranging"
[noise]
noise_model = "empirical"
noise_samples = { file = "/etc/passwd", column = "root" }
[[method]]
solver = "ols"
)";
  const std::string map = R"(experiment = "building"
[building]
map = { file = "/etc/passwd" }
[[method]]
solver = "ols"
)";
  const auto [text, line] = GENERATE_COPY(table<std::string, std::string>({{samples, "4"}, {map, "3"}}));
  const std::string message = tests::refusal_of([&, study = text] { read_study({"r", "r.h5", study, false}); });
  CHECK(tests::lacking(message, {"r.h5:" + line + ": ", "names a file, which is not read"}) == "");
}
