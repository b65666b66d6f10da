#include "studies/files/study_reader.hpp"

#include <algorithm>
#include <fstream>

#include "sim/range_noise.hpp"
#include "studies/files/study_writer.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/scratch_folder.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

const std::string valid = R"(experiment = "ranging"
trials = 10
[scene]
depth_m = [2, 8]
[sweep]
points = [3, 5]
[[method]]
solver = "rr"
k = "fixed"
k_fixed = 0.5
)";

Study read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return read_study({"demo", "demo.toml", text}, overrides);
}

/// The error message of a study, empty if there is none.
std::string error_of(const std::string& text, const std::vector<std::string>& overrides = {}) {
  return tests::refusal_of([&] { make_plan(read(text, overrides)); });
}

/// `valid` with one piece replaced.
std::string with(const std::string& piece, const std::string& replacement) {
  std::string text = valid;
  const auto at = text.find(piece);
  REQUIRE(at != std::string::npos);
  return text.replace(at, piece.size(), replacement);
}

}  // namespace

TEST_CASE("a study is read with its defaults filled in") {
  const Study study = read(valid);
  CHECK(study.title == "demo");
  CHECK(study.aims.empty());
  CHECK(study.seed == 2018);
  CHECK(study.trials == 10);
  CHECK(std::get<Interval>(study.fixed.at("depth_m")) == Interval{2, 8});
  CHECK(std::get<double>(study.fixed.at("range_sigma_m")) == 0.1);
  CHECK_FALSE(study.fixed.contains("points"));
  REQUIRE(study.sweep.size() == 1);
  CHECK(study.sweep[0].values == std::vector<Value>{std::int64_t{3}, std::int64_t{5}});
  REQUIRE(study.methods.size() == 1);
  CHECK(study.methods[0].label == "rr");
  CHECK(std::get<double>(study.methods[0].given.at("k_fixed")) == 0.5);
}

TEST_CASE("the aims of a study go into its result and change no number") {
  const std::string text = "aims = \"\"\"\nWhich one\nis \"better\"?\"\"\"\n" + valid;
  CHECK(read(text).aims == "Which one\nis \"better\"?");
  CHECK(read(resolved_toml(read(text))).aims == read(text).aims);
  CHECK(make_plan(read(text)).header.aims == read(text).aims);
  CHECK(make_plan(read(text)).header.study_hash == make_plan(read(valid)).header.study_hash);
  CHECK(error_of("aims = 3\n" + valid).find("aims") != std::string::npos);
}

TEST_CASE("a resolved study reads back as itself, and so does the template") {
  for (const std::string& text :
       {valid, template_toml(*find_experiment("ranging")), find_study("fig3a").text, find_study("fig3bcd").text}) {
    const std::string resolved = resolved_toml(read(text));
    CHECK(resolved_toml(read(resolved)) == resolved);
    CHECK(make_plan(read(resolved)).header.study_hash == make_plan(read(text)).header.study_hash);
  }
}

TEST_CASE("overrides replace, add and reach into tables and methods") {
  const Study study = read(valid, {"scene.depth_m=[1, 3]", "trials=77", "noise.range_sigma_m=0.25",
                                   "method.0.k=kibria_gm", "sweep.points=[4]"});
  CHECK(std::get<Interval>(study.fixed.at("depth_m")) == Interval{1, 3});
  CHECK(study.trials == 77);
  CHECK(std::get<double>(study.fixed.at("range_sigma_m")) == 0.25);
  CHECK(std::get<std::string>(study.methods[0].given.at("k")) == "kibria_gm");
  CHECK(study.sweep[0].values == std::vector<Value>{std::int64_t{4}});
}

TEST_CASE("a whole number may be written as a real one, and is that number exactly") {
  CHECK(read(with("trials = 10", "trials = 1e6")).trials == 1'000'000);
  CHECK(read(valid, {"trials=2.5e3"}).trials == 2500);
  CHECK(read(with("trials = 10", "seed = 9007199254740992.0")).seed == 9007199254740992);
  CHECK(read(with("[3, 5]", "[3.0, 0.5e1]")).sweep[0].values == read(valid).sweep[0].values);
  CHECK(resolved_toml(read(valid, {"trials=1e6"})) == resolved_toml(read(valid, {"trials=1000000"})));
}

TEST_CASE("messages echo numbers in their shortest form, and no more of a text than is needed to find it") {
  CHECK(error_of(with("[2, 8]", "[2, -0.1]")).find("scene.depth_m = [ 2, -0.1 ] is not allowed") != std::string::npos);
  CHECK(error_of(valid, {"noise.range_sigma_m=-0.1"}).find("= -0.1 is not allowed") != std::string::npos);
  const std::string digits(400, '7');
  for (const std::string key : {"trials", "noise.range_sigma_m", "scene.depth_m", "method.0.k", "nothing"}) {
    INFO(key);
    const std::string message = error_of(valid, {key + "=" + digits});
    CHECK(message.find("777...") != std::string::npos);
    CHECK(message.find(digits.substr(0, 100)) == std::string::npos);
  }
}

TEST_CASE("overrides replace whole entries of lists, and add one behind the last") {
  const Study study =
      read(valid, {"method.0={solver=\"ols\"}", "method.1={solver=\"lm\", name=\"b\"}", "sweep.points.1=7",
                   "sweep.points.2=9", "method.2={solver=\"rr\"}", "method.2.k=fixed"});
  REQUIRE(study.methods.size() == 3);
  CHECK(study.methods[0].label == "ols");
  CHECK(study.methods[1].label == "b");
  CHECK(std::get<std::string>(study.methods[2].given.at("k")) == "fixed");
  CHECK(study.sweep[0].values == std::vector<Value>{std::int64_t{3}, std::int64_t{7}, std::int64_t{9}});
  CHECK(error_of(valid, {"method.2={solver=\"ols\"}"}) ==
        "--set method.2={solver=\"ols\"}: \"2\" is not a position in a list of 1 (they count from 0)");
  CHECK(error_of(valid, {"method.1={solver=\"olx\"}"}).starts_with("--set method.1={solver=\"olx\"}: solver: unknown"));
}

TEST_CASE("a range keeps its digits, and exclude finds its values") {
  const Study study = read(with("points = [3, 5]",
                                "range_sigma_m = { from = 0.1234567890123456, to = 2.1234567890123456, step = 1 }\n"
                                "exclude = [{ range_sigma_m = 0.1234567890123456 }]"));
  CHECK(std::get<double>(study.sweep[0].values[0]) == 0.1234567890123456);
  CHECK(make_plan(study).cells.size() == 2);
}

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

TEST_CASE("each bad study gets one line with file, line, bound and nearest name") {
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {"[", "demo.toml:1: not valid TOML"},
      {"trials = 10\n", "demo.toml: the key \"experiment\" is missing; add experiment = \"ranging\""},
      {with("\"ranging\"", "\"rangin\""), "demo.toml:1: experiment: unknown \"rangin\" (did you mean \"ranging\"?)"},
      {with("trials", "trails"), "demo.toml:2: unknown key \"trails\" in the study (did you mean \"trials\"?)"},
      {with("trials = 10", "trials = 0"),
       "demo.toml:2: trials = 0 is not allowed: trials takes a whole number from 1 to 1000000000000"},
      {with("trials = 10", "trials = 1.5"), "demo.toml:2: trials = 1.5 is not allowed"},
      {with("trials = 10", "trials = 1.5e0"),
       "demo.toml:2: trials = 1.5 is not allowed: trials takes a whole number from 1 to 1000000000000"},
      {with("trials = 10", "seed = 1e16"), "demo.toml:2: seed = 1e+16 is not allowed"},
      {with("trials = 10", "trials = inf"), "demo.toml:2: trials = inf is not allowed"},
      {with("trials = 10", "trials = \"many\""), "demo.toml:2: trials = 'many' is not allowed"},
      {with("depth_m", "dept_m"), "demo.toml:4: unknown key \"dept_m\" in [scene] (did you mean \"depth_m\"?)"},
      {with("[2, 8]", "[8, 2]"),
       "demo.toml:4: scene.depth_m = [ 8, 2 ] is not allowed: scene.depth_m takes two numbers"},
      {with("[2, 8]", "[2]"), "demo.toml:4: scene.depth_m = [ 2 ] is not allowed"},
      {with("[2, 8]", "[nan, 8]"), "demo.toml:4: scene.depth_m = [ nan, 8 ] is not allowed"},
      {with("[2, 8]", "4"), "demo.toml:4: scene.depth_m = 4 is not allowed"},
      {with("[3, 5]", "[]"), "demo.toml:6: sweep.points is an empty list"},
      {with("[3, 5]", "[3, 5, 3]"), "demo.toml:6: sweep.points lists 3 twice"},
      {with("[3, 5]", "[2, 5]"),
       "demo.toml:6: sweep.points = 2 is not allowed: sweep.points takes a whole number from 3 to 1000"},
      {with("[3, 5]", "5"), "demo.toml:6: sweep.points must be a list of values or a range"},
      {with("[3, 5]", "{ from = 3, to = 2, step = 1 }"),
       "demo.toml:6: sweep.points: from 3 to 2 in steps of 1 is no range"},
      {with("[3, 5]", "{ from = 3, to = 4, step = 0 }"),
       "demo.toml:6: sweep.points: from 3 to 4 in steps of 0 is no range"},
      {with("[3, 5]", "{ from = 3, to = 4 }"),
       "demo.toml:6: sweep.points: a range takes from, to and step; \"step\" is missing"},
      {with("[3, 5]", "{ from = 3, to = 4, step = 0.5 }"),
       "demo.toml:6: sweep.points: the range repeats a value or leaves what is allowed"},
      {with("points = [3, 5]", "range_sigma_m = { from = 0.1, to = 0.35, step = 0.1 }"),
       "demo.toml:6: sweep.range_sigma_m: from 0.1 in steps of 0.1 comes to 0.3 and 0.4, not to 0.35; let the range "
       "end"},
      {with("points = [3, 5]", "range_sigma_m = { from = 1e-9, to = 1e4, step = 1e3 }"),
       "demo.toml:6: sweep.range_sigma_m: from 1e-09 in steps of 1000"},
      {with("points = [3, 5]", "similarty = [1]"),
       "demo.toml:6: unknown key \"similarty\" in [sweep] (did you mean \"similarity\"?)"},
      {with("points = [3, 5]", ""), "demo.toml:5: [sweep] names no axis"},
      {with("points = [3, 5]", "theta_m = [1]"), "demo.toml:5: sweep.theta_m changes nothing: no [[method]] reads it"},
      {with("points = [3, 5]", "k_fixed = [1]"), "demo.toml:10: \"k_fixed\" is swept in [sweep] too"},
      {with("[scene]", "[scene]\npoints = 4"),
       "demo.toml:4: scene.points is swept in [sweep] too; give it in one place"},
      {with("solver = \"rr\"", ""), "demo.toml:7: [[method]] lacks a solver"},
      {with("\"rr\"", "\"rrx\""), "demo.toml:8: solver: unknown \"rrx\" (did you mean \"rr\"?)"},
      {with("\"rr\"", "\"ols\""), "demo.toml:9: unknown key \"k\" in [[method]] with solver \"ols\""},
      {with("\"fixed\"", "\"fixd\""), "(did you mean \"fixed\"?)"},
      {with("k_fixed = 0.5", "v_mode = \"prior\""),
       "demo.toml:10: v_mode changes nothing in this [[method]]: it is read only if model is pseudorange"},
      {with("k_fixed = 0.5", "k_fixed = -0.5"),
       "demo.toml:10: k_fixed = -0.5 is not allowed: k_fixed takes a number from 0 to"},
      {valid + "name = \"a/b\"\n", "demo.toml:11: method name \"a/b\" is not allowed"},
      {valid + "name = \"scene\"\n", "demo.toml:11: method name \"scene\" is taken by the experiment itself"},
      {valid + "[[method]]\nsolver = \"lm\"\n[[method]]\nsolver = \"ols\"\nname = \"lm - rr\"\n",
       "demo.toml:13: the name \"lm - rr\" of this [[method]] is that of the comparison of \"lm\" with \"rr\"; choose"},
      {valid + "[[method]]\nsolver = \"lm\"\nname = \"a\"\n[[method]]\nsolver = \"ols\"\nname = \"rr - a\"\n"
               "[[compare]]\nmethod = \"rr\"\nwith = \"a\"\n",
       "demo.toml:14: the name \"rr - a\" of this [[method]]"},
      {valid + "[[method]]\nsolver = \"rr\"\n", "demo.toml:12: two methods are called \"rr\""},
      {"experiment = \"ranging\"\n", "demo.toml: no [[method]]; add at least one"},
      {"experiment = \"ranging\"\nmethod = 3\n", "demo.toml:2: method must be a list of tables: [[method]]"},
      {valid + "[[figure]]\nx = \"point\"\ny = \"error_m\"\n",
       "demo.toml:12: figure.x: unknown \"point\" (did you mean \"points\"?)"},
      {valid + "[[figure]]\nx = \"points\"\ny = \"eror_m\"\n",
       "demo.toml:13: figure.y: unknown \"eror_m\" (did you mean \"error_m\"?)"},
      {valid + "[[figure]]\nx = \"points\"\n", "demo.toml:11: [[figure]] lacks y"},
      {valid + "[[figure]]\nx = \"points\"\ny = \"error_m\"\nname = \"../evil\"\n",
       "demo.toml:14: figure name \"../evil\" is not allowed"},
      {valid + "[store]\ntrial_columns_mib = -1\n", "demo.toml:12: store.trial_columns_mib = -1 is not allowed"},
      {with("points = [3, 5]", "points = [3]\nexclude = [{ points = 3 }]"),
       "demo: sweep.exclude leaves no cell at all"},
      {with("points = [3, 5]", "points = [3]\nexclude = [{ points = 4 }]"),
       "sweep.exclude.points is not among the values"},
      {with("points = [3, 5]", "points = [3, 4]\nrange_sigma_m = [0.1]\nzip = [[\"points\", \"range_sigma_m\"]]"),
       "demo.toml:8: sweep.zip: points has 2 values and range_sigma_m has 1"},
      {with("points = [3, 5]", "points = [3, 4]\nzip = [[\"points\"]]"), "demo.toml:7: sweep.zip needs two axes"},
  }));
  const std::string error = error_of(text);
  INFO(text << "\n-> " << error);
  CHECK(error.find(message) != std::string::npos);
  CHECK(error.find('\n') == std::string::npos);
}

namespace {

/// `valid` with these lines in [noise], from line 4 on.
std::string noise(const std::string& lines) {
  return with("[scene]\n", "[noise]\n" + lines + "[scene]\n");
}
std::string samples(const std::string& value) {
  return noise("noise_model = \"empirical\"\nnoise_samples = " + value + "\n");
}

/// A folder with a file of residuals, removed at the end.
struct Residuals {
  Residuals() {
    std::ofstream(folder / "residuals.csv") << "id,e_m,unit\n1,0.5,m\n2,-1.5,m\n3,0.25,m\n";
    std::ofstream many(folder / "many.csv");
    many << "e_m\n";
    for (int i = 0; i <= 100'000; ++i) many << "1\n";
  }

  const tests::ScratchFolder folder;
};

}  // namespace

TEST_CASE("samples enter the resolved study, from a list or from a file beside the study, and the hash") {
  const Residuals residuals;
  const std::string text = samples("{ file = \"residuals.csv\", column = \"e_m\" }");
  const Study study = read_study({"demo", (residuals.folder / "demo.toml").string(), text});
  CHECK(std::get<Samples>(study.fixed.at("noise_samples")) == Samples({0.5, -1.5, 0.25}));
  const std::string resolved = resolved_toml(study);
  CHECK(resolved.find("noise_samples = [0.5, -1.5, 0.25]\n") != std::string::npos);
  CHECK(resolved_toml(read(resolved)) == resolved);

  const auto hash = [](const Study& s) { return make_plan(s).header.study_hash; };
  CHECK(hash(read(samples("[0.5, -1.5, 0.25]"))) == hash(study));
  CHECK(hash(read(samples("[0.5, -1.5, 0.125]"))) != hash(study));

  // Paths of an override start from the working directory.
  const std::string file = (residuals.folder / "residuals.csv").string();
  CHECK(resolved_toml(read(samples("[1, 2]"), {"noise.noise_samples={file=\"" + file + "\",column=\"e_m\"}"})) ==
        resolved);
}

TEST_CASE("each bad list or file of samples gets one line") {
  const Residuals residuals;
  const std::string folder = residuals.folder.path().string() + "/";
  const auto file = [&](const std::string& name, const std::string& column) {
    return samples("{ file = \"" + folder + name + "\", column = \"" + column + "\" }");
  };
  const std::vector<std::pair<std::string, std::string>> cases = {
      {noise("noise_model = \"empirical\"\n"),
       "demo.toml: noise_model = \"empirical\" needs noise.noise_samples: a list"},
      {samples("[]"), "demo.toml: noise_model = \"empirical\" needs noise.noise_samples"},
      {samples("[1]"), "demo.toml:5: noise.noise_samples: too few samples, 1; give 2 at least"},
      {samples("[0, 0.0]"), "demo.toml:5: noise.noise_samples: the samples are all zero"},
      {samples("[1, \"x\"]"), "demo.toml:5: noise.noise_samples[1] is not a number"},
      {samples("[1, nan]"),
       "demo.toml:5: noise.noise_samples: nan is not allowed: samples are numbers from -1000000 to"},
      {samples("[1, 2e6]"), "demo.toml:5: noise.noise_samples: 2000000 is not allowed"},
      {samples("3"),
       "demo.toml:5: noise.noise_samples = 3 is not allowed: noise.noise_samples takes a list of numbers"},
      {samples("{ file = \"a.csv\" }"), "demo.toml:5: noise.noise_samples lacks column"},
      {samples("{ column = \"a\" }"), "demo.toml:5: noise.noise_samples lacks file"},
      {samples("{ file = \"a.csv\", columm = \"a\" }"), "demo.toml:5: unknown key \"columm\" in noise.noise_samples"},
      {file("residual.csv", "e_m"),
       "demo.toml:5: noise.noise_samples.file: there is no file " + folder + "residual.csv"},
      {file("residuals.csv", "em"), "residuals.csv:1: no column \"em\" (did you mean \"e_m\"?)"},
      {file("residuals.csv", "unit"), "residuals.csv:2: \"m\" in column \"unit\" is not a number"},
      {file("many.csv", "e_m"), "demo.toml:5: noise.noise_samples: at most 100000 samples are allowed"},
      {with("points = [3, 5]", "noise_samples = [[1, 2]]"), "demo.toml:6: noise_samples cannot be swept"},
      {with("points = [3, 5]", "noise_dof = [3, 4]"),
       "demo.toml:5: sweep.noise_dof changes nothing: it is read only if noise_model is student_t"},
      {with("points = [3, 5]", "noise_model = [\"normal\", \"student_t\"]\noutlier_rate = [0, 0.1]"),
       "demo.toml:5: sweep.outlier_rate changes nothing: it is read only if noise_model is contaminated"},
      {with("points = [3, 5]", "score_low = [0.2, 0.5]"),
       "demo.toml:5: sweep.score_low changes nothing: it is read only if scores is random"},
      {with("points = [3, 5]", "noise_model = [\"normal\", \"empirical\"]"),
       "demo.toml: noise_model = \"empirical\" needs noise.noise_samples"},
      {noise("noise_dof = 2\n"),
       "demo.toml:4: noise.noise_dof = 2 is not allowed: noise.noise_dof takes a number from 2.1"},
  };
  for (const auto& [text, message] : cases) {
    const std::string error = error_of(text);
    INFO(text << "\n-> " << error);
    CHECK(error.find(message) != std::string::npos);
    CHECK(error.find('\n') == std::string::npos);
  }
}

TEST_CASE("settings that nothing reads may stand in their section, and may be swept where something reads them") {
  CHECK(error_of(noise("noise_dof = 4.5\nscore_low = 0.5\nnoise_samples = [1, 2]\n")) == "");
  CHECK(error_of(with("points = [3, 5]", "noise_model = [\"normal\", \"student_t\"]\nnoise_dof = [3, 4]")) == "");
  CHECK(error_of(with("points = [3, 5]", "scores = [\"none\", \"random\"]\nscore_low = [0.2, 0.5]")) == "");
}

TEST_CASE("every option of a noise model is a setting that is read if the model is chosen") {
  for (const sim::NoiseEntry& entry : sim::noise_registry()) {
    for (const std::string_view option : entry.options) {
      const auto settings = find_experiment("ranging")->settings();
      const auto setting = std::ranges::find(settings, option, &Setting::name);
      INFO(option);
      REQUIRE(setting != settings.end());
      CHECK(setting->read_if.setting == "noise_model");
      CHECK(std::ranges::count(setting->read_if.choices, entry.name) == 1);
    }
  }
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

TEST_CASE("a bad override is named as it was given") {
  CHECK(error_of(valid, {"scene.depth_m=[2,1]"}).starts_with("--set scene.depth_m=[2,1]: scene.depth_m = [ 2, 1 ]"));
  CHECK(error_of(valid, {"scene.dept_m=1"}).starts_with("--set scene.dept_m=1: unknown key \"dept_m\" in [scene]"));
  CHECK(error_of(valid, {"trials"}) == "--set trials: expected KEY=VALUE, for example scene.depth_m=[2,15]");
  CHECK(error_of(valid, {"method.3.k=fixed"}).starts_with("--set method.3.k=fixed: \"3\" is not a position"));
  CHECK(error_of(valid, {"foo.bar=1"}).starts_with("--set foo.bar=1: unknown key \"foo\" in the study"));
  CHECK(error_of(valid, {"seed=1\ntrials=5"}).find("expected one KEY=VALUE") != std::string::npos);
  CHECK(error_of(valid, {"trials.x=1"}).starts_with("--set trials.x=1: "));
}

TEST_CASE("methods are compared with the first one, or as [[compare]] says") {
  const std::string methods =
      "experiment = \"ranging\"\n[[method]]\nsolver = \"ols\"\n[[method]]\nsolver = \"rr\"\n[[method]]\nsolver = "
      "\"rrr\"\n";
  const auto comparisons = [&](const std::string& text) {
    return read_study({"s", "s.toml", methods + text}).comparisons;
  };
  CHECK(comparisons("") == std::vector<Comparison>{{"rr", "ols"}, {"rrr", "ols"}});
  CHECK(comparisons("[[compare]]\nmethod = \"rrr\"\nwith = \"rr\"\n") == std::vector<Comparison>{{"rrr", "rr"}});
  const Study none = read_study({"s", "s.toml", methods}, std::vector<std::string>{"compare=[]"});
  CHECK(none.comparisons.empty());
  CHECK(read_study({"s", "s.toml", resolved_toml(none)}).comparisons.empty());
  const auto refused = [&](const std::string& text) {
    return tests::refusal_of([&] { comparisons("[[compare]]\n" + text); });
  };
  CHECK(refused("method = \"rrr\"\n") == "s.toml:8: [[compare]] lacks with = \"...\", the name of a [[method]]");
  CHECK(refused("method = \"rrr\"\nwith = \"rrr\"\n") == "s.toml:8: [[compare]] compares \"rrr\" with itself");
  CHECK(refused("method = \"rrr\"\nwith = \"r\"\n").find("s.toml:10") == 0);
}

TEST_CASE("a study that is not there names the nearest one in the catalog") {
  CHECK(tests::refusal_of([] { find_study("fig3"); }) ==
        "fig3: no such study file, and no study of that name in the catalog (did you mean \"fig3a\"?)");
  CHECK(find_study("fig3a").name == "fig3a");
}
