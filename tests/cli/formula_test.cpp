// A formula of K through the whole program.

#include <algorithm>
#include <string>
#include <vector>

#include "tests/cli/program.hpp"
#include "tests/cli/small_result.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc::tests;

namespace {

const std::string two_methods = R"--(experiment = "ranging"
trials = 3000
audit = 0.02
[sweep]
points = [4, 6]
[[method]]
solver = "rr"
k = "hkb"
[[method]]
solver = "rr"
name = "spelled"
k = "expr"
k_expr = "p * sigma2 / sum(alpha ^ 2)"
[[figure]]
name = "error"
x = "points"
y = "error_all_m"
group = "method"
)--";

/// Column `at` of the lines of a CSV text that have the method.
std::vector<std::string> column(const std::string& csv, const std::string& method, std::size_t at) {
  std::vector<std::string> values;
  for (const std::string& line : lines_of(csv)) {
    if (!contains(line, "," + method + ",")) continue;
    std::size_t begin = 0;
    for (std::size_t i = 0; i < at; ++i) begin = line.find(',', begin) + 1;
    values.push_back(line.substr(begin, line.find(',', begin) - begin));
  }
  return values;
}

}  // namespace

TEST_CASE("a formula is run, continued, merged, verified, replayed, audited and drawn like any K") {
  const WithStudy folder(two_methods);
  const auto ok = [&](const std::string& arguments) {
    const Outcome outcome = folder.ridgeloc(arguments);
    INFO(arguments << ": " << outcome.error);
    CHECK(outcome.exit_code == 0);
    return outcome.out;
  };
  ok("run s.toml --isa baseline -o whole.h5");
  ok("run s.toml --isa baseline -o parts.h5 --trials 1000 --threads 1");
  ok("run s.toml --isa baseline -o parts.h5 --threads 2");
  CHECK(ok("verify whole.h5 --digest") == ok("verify parts.h5 --digest"));
  ok("verify whole.h5");
  ok("run s.toml --isa baseline --shard 1/2 -o one.h5");
  ok("run s.toml --isa baseline --shard 2/2 -o two.h5");
  ok("merge one.h5 two.h5 -o both.h5");
  CHECK(ok("verify both.h5 --digest") == ok("verify whole.h5 --digest"));
  CHECK(contains(ok("replay whole.h5 --cell points=4 --trial 7"), "spelled, iterations"));
  CHECK(contains(ok("audit whole.h5"), "spelled"));
  CHECK(contains(ok("export whole.h5 --study"), "k_expr = \"p * sigma2 / sum(alpha ^ 2)\""));
  CHECK(contains(ok("summary whole.h5"), "spelled"));
  ok("plot whole.h5 -o error.svg");
  CHECK(contains(folder.read("error.svg"), "spelled"));
  ok("report whole.h5 -o whole.html");
  CHECK(contains(folder.read("whole.html"), "spelled"));

  // The same numbers as the estimator that it spells, trial by trial, to rounding.
  const std::string trials = ok("export whole.h5 --trials");
  const auto header = lines_of(trials).front();
  const auto before = header.substr(0, header.find("error_all_m"));
  const auto at = static_cast<std::size_t>(std::count(before.begin(), before.end(), ','));
  const auto built_in = column(trials, "rr", at);
  const auto formula = column(trials, "spelled", at);
  REQUIRE(built_in.size() == 6000);
  REQUIRE(formula.size() == 6000);
  std::size_t different = 0;
  for (std::size_t t = 0; t < formula.size(); ++t)
    different += std::stod(formula[t]) == Approx(std::stod(built_in[t])).epsilon(1e-9) ? 0 : 1;
  // Rounding may turn a trial that passes near a singular matrix or the stop rule.
  CHECK(different <= 2);
}

TEST_CASE("a formula locates photos in a building") {
  const WithStudy folder(
      "experiment = \"building\"\ntrials = 30\n[[method]]\nsolver = \"rrr\"\n"
      "[[method]]\nsolver = \"rrr\"\nname = \"spelled\"\nk = \"expr\"\nk_expr = \"geomean(sigma2 / alpha^2)\"\n");
  const Outcome run = folder.ridgeloc("run s.toml -o s.h5");
  INFO(run.error);
  REQUIRE(run.exit_code == 0);
  CHECK(folder.ridgeloc("verify s.h5").exit_code == 0);
  CHECK(contains(folder.ridgeloc("replay s.h5 --trial 3").out, "spelled"));
}

TEST_CASE("a formula that is wrong ends a run with its column and exit code 2") {
  const WithStudy folder(two_methods);
  const Outcome outcome = folder.ridgeloc("run s.toml -o s.h5 --set 'method.1.k_expr=p * sigma / n'");
  CHECK(outcome.exit_code == 2);
  CHECK(line_count(outcome.error) == 1);
  CHECK(contains(outcome.error, "column 5: there is no \"sigma\" (did you mean \"sigma2\"?)"));
  CHECK_FALSE(folder.has("s.h5"));
  CHECK(folder.ridgeloc("run s.toml -o s.h5 --trials 50 --set 'method.1.k_expr=sigma2 / n'").exit_code == 0);
  CHECK(contains(folder.ridgeloc("list k").out, "k_expr: geomean(v)"));
}
