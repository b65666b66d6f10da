// A result whose study names what this program does not have: an estimator of K, a solver or an experiment of another
// one.

#include <string>

#include "core/isa.hpp"
#include "studies/registry.hpp"
#include "tests/cli/program.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/sample_writer.hpp"

using namespace ridgeloc;
using namespace ridgeloc::tests;

namespace {

const std::string study = R"(experiment = "ranging"
[[method]]
solver = "rr"
k = "mine"
)";

/// The sample result, said to be of an experiment, with this study in it.
struct WithForeignResult : WorkingFolder {
  WithForeignResult(const std::string& experiment, const std::string& study_toml) {
    results::Header header = sample_header();
    header.experiment = experiment;
    header.isa = core::name_of(core::Isa::Baseline);
    const studies::Experiment* known = studies::find_experiment(experiment);
    if (known != nullptr) header.experiment_version = known->version();
    header.study_toml = study_toml;
    results::ResultWriter writer(path() / "a.h5", header);
    run_missing(writer, header, sample_tasks(header));
    writer.seal({});
    write("own.toml", "experiment = \"ranging\"\ntrials = 10\n[[method]]\nsolver = \"rr\"\n");
  }
};

}  // namespace

TEST_CASE("a result whose K is not in this program is shown all the same, and computing is refused in one line") {
  const auto [experiment, toml, missing] = GENERATE(table<std::string, std::string, std::string>(
      {{"ranging", study, "a.h5:4: k = 'mine' is not allowed"},
       {"ranging", "experiment = \"ranging\"\n[[method]]\nsolver = \"rr\"\nk = \"expr\"\nk_expr = \"erf(n)\"\n",
        "a.h5:5: k_expr = 'erf(n)' is not allowed: column 1: there is no \"erf\""},
       {"ranging", "experiment = \"ranging\"\n[[method]]\nsolver = \"mine\"\n", "a.h5:3: solver: unknown \"mine\""},
       {"mine", "experiment = \"mine\"\n", "a.h5:1: experiment: unknown \"mine\""}}));
  const WithForeignResult folder(experiment, toml);
  for (const char* arguments :
       {"summary a.h5", "summary --all a.h5", "plot a.h5 --figure error", "plot a.h5 --y iterations -o y.svg",
        "report a.h5", "export a.h5", "export a.h5 --json", "export a.h5 --latex", "export a.h5 --trials",
        "export a.h5 --failures", "export a.h5 --study", "export a.h5 --against points=3", "verify a.h5 --blocks 0",
        "verify a.h5 --digest", "compare a.h5 a.h5"}) {
    const Outcome outcome = folder.ridgeloc(arguments);
    INFO(arguments << ": " << outcome.error);
    CHECK(outcome.exit_code == 0);
    CHECK(outcome.error.empty());
  }
  CHECK(folder.ridgeloc("export a.h5 --study").out == toml);
  for (const char* arguments : {"verify a.h5", "replay a.h5 --trial 0", "audit a.h5", "merge a.h5 a.h5 -o b.h5"}) {
    const Outcome outcome = folder.ridgeloc(arguments);
    INFO(arguments << ": " << outcome.error);
    CHECK(outcome.exit_code == 2);
    CHECK(line_count(outcome.error) == 1);
    CHECK(contains(outcome.error, "a.h5: this program lacks what its study names, and cannot compute any of it: "));
    CHECK(contains(outcome.error, missing));
  }
  // A result of another experiment is another study, whatever that is.
  const Outcome continued = folder.ridgeloc("run own.toml -o a.h5");
  CHECK(continued.exit_code == 2);
  CHECK(line_count(continued.error) == 1);
  CHECK(folder.ridgeloc("verify a.h5 --blocks 0").exit_code == 0);
}
