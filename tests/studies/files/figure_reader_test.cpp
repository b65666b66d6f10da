#include "studies/files/study_writer.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/valid_study.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using tests::error_of;
using tests::read;
using tests::valid;
using tests::with;

TEST_CASE("a figure without a name is called after the study, in letters that a file may have") {
  const auto named = [](const std::string& study) {
    return read_study({study, study + ".toml",
                       valid + "[[figure]]\nx = \"points\"\ny = \"error_m\"\n"
                               "[[figure]]\nx = \"points\"\ny = \"iterations\"\n"})
        .figures;
  };
  CHECK(named("my study")[0].name == "my-study");
  CHECK(named("my study")[1].name == "my-study-2");
  CHECK(named("study (1)")[0].name == "study--1-");
  CHECK(named("größe")[0].name == "größe");
  CHECK(named("a+b")[0].name == "a-b");
  CHECK(named("..hidden")[0].name == "hidden");
  CHECK(named("...")[0].name == "figure");
}

TEST_CASE("a figure can do without bounds") {
  const std::string text =
      "experiment = \"ranging\"\n[sweep]\npoints = [3, 5]\n[[method]]\nsolver = \"rr\"\n[[figure]]\n";
  const std::string curve = text + "x = \"points\"\ny = \"error_m\"\n";
  CHECK(read(curve).figures[0].bounds);
  const std::string without = resolved_toml(read(curve + "bounds = false\n"));
  CHECK_FALSE(read(without).figures[0].bounds);
  CHECK(error_of(text + "kind = \"ecdf\"\ny = \"error_m\"\nbounds = true\n")
            .find("figure.bounds does not go with kind = \"ecdf\"") != std::string::npos);
}

TEST_CASE("a figure is restricted to values of the sweep") {
  const std::string text = R"(experiment = "ranging"
[sweep]
points = [3, 5]
depth_m = [[1, 5], [1, 10]]
noise_model = ["normal", "student_t"]
[[method]]
solver = "rr"
)";
  const std::string figure = "[[figure]]\nx = \"points\"\ny = \"error_m\"\nwhere = ";
  const auto where = [&](const std::string& value) { return read(text + figure + value + "\n").figures[0].where; };
  CHECK(where("{ points = 3 }") == results::AxisValues{{"points", {"3"}}});
  CHECK(where("{ points = [3, 5], noise_model = \"normal\" }") ==
        results::AxisValues{{"noise_model", {"normal"}}, {"points", {"3", "5"}}});
  CHECK(where("{ depth_m = [1, 5] }") == where("{ depth_m = [[1, 5]] }"));
  for (const char* value : {"{ points = [3], noise_model = \"normal\" }", "{ depth_m = [[1, 5], [1, 10]] }"}) {
    const std::string resolved = resolved_toml(read(text + figure + value + "\n"));
    CHECK(resolved_toml(read(resolved)) == resolved);
    CHECK(read(resolved).figures[0].where == where(value));
  }
  const auto refused = [&](const std::string& value) { return error_of(text + figure + value + "\n"); };
  CHECK(refused("{ point = 3 }").find("unknown key \"point\" in figure.where (did you mean \"points\"?)") !=
        std::string::npos);
  CHECK(refused("{ points = 4 }").find("figure.where.points is not among the values of that axis") !=
        std::string::npos);
  CHECK(refused("{ points = [] }").find("figure.where.points is an empty list") != std::string::npos);
  CHECK(refused("3").find("figure.where must be a table") != std::string::npos);
}

TEST_CASE("a figure of a distribution has no axis") {
  const std::string figure = "[[figure]]\nkind = \"ecdf\"\n";
  const std::string unswept = with("[sweep]\npoints = [3, 5]\n", "");
  const Study study = read(unswept + figure + "y = \"error_m\"\n");
  CHECK(study.figures[0].kind == "ecdf");
  CHECK(study.figures[0].x.empty());
  CHECK(resolved_toml(read(resolved_toml(study))) == resolved_toml(study));
  const auto refused = [&](const std::string& lines) { return error_of(valid + figure + lines); };
  CHECK(refused("y = \"error_m\"\nx = \"points\"\n").find("demo.toml:14: figure.x does not go with kind") == 0);
  CHECK(refused("y = \"error_m\"\nstatistic = \"mean\"\n").find("figure.statistic does not go") != std::string::npos);
  CHECK(refused("y = \"converged\"\n").find("takes one metric as y") != std::string::npos);
  CHECK(refused("y = \"ref_converged\"\n").find("none that is yes or no") != std::string::npos);
  CHECK(refused("y = [\"error_m\", \"iterations\"]\n").find("takes one metric as y") != std::string::npos);
  CHECK(error_of(valid + "[[figure]]\nkind = \"edcf\"\ny = \"error_m\"\n").find("did you mean \"ecdf\"?") !=
        std::string::npos);
}
