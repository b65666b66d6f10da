// Any lines as values of --set, on a study that has something of everything.

#include <sstream>
#include <vector>

#include "studies/files/study_reader.hpp"
#include "studies/registry.hpp"
#include "tests/fuzz/refused.hpp"

using namespace ridgeloc;

namespace {

const std::string study = R"(experiment = "ranging"
[scene]
depth_m = [2, 8]
[sweep]
points = [3, 5]
zip = [["points", "range_sigma_m"]]
range_sigma_m = [0.1, 0.2]
[[method]]
solver = "rr"
k = "fixed"
[[method]]
solver = "irls"
[[compare]]
method = "irls"
with = "rr"
[stop]
metric = "error_m"
target = 0.1
[[figure]]
x = "points"
y = ["error_m"]
)";

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::istringstream lines(tests::text_of(data, size));
  std::vector<std::string> overrides;
  for (std::string line; std::getline(lines, line) && overrides.size() < 4;) {
    if (line.find("file") == std::string::npos) overrides.push_back(line);  // they may name any file
  }
  tests::is_refused([&] { studies::read_study({"fuzz", "fuzz.toml", study, false}, overrides); });
  return 0;
}
