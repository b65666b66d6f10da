#include "studies/files/study_reader.hpp"

#include <fstream>

#include "studies/files/study_writer.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/valid_study.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using tests::error_of;
using tests::read;
using tests::valid;
using tests::with;

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

TEST_CASE("a range keeps its digits, and exclude finds its values") {
  const Study study = read(with("points = [3, 5]",
                                "range_sigma_m = { from = 0.1234567890123456, to = 2.1234567890123456, step = 1 }\n"
                                "exclude = [{ range_sigma_m = 0.1234567890123456 }]"));
  CHECK(std::get<double>(study.sweep[0].values[0]) == 0.1234567890123456);
  CHECK(make_plan(study).cells.size() == 2);
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
      {with("points = [3, 5]",
            "points = [3, 4, 3]\nrange_sigma_m = [0.1, 0.1, 0.1]\nzip = [[\"points\", \"range_sigma_m\"]]"),
       "demo.toml:8: sweep.zip: points = 3, range_sigma_m = 0.1 stands there twice; zipped values differ in one axis"},
      {with("points = [3, 5]", "points = [3, 4]\nzip = [[\"points\"]]"), "demo.toml:7: sweep.zip needs two axes"},
      {with("points = [3, 5]", "start_offset_m = [0.0, 1, -0.0]"), "demo.toml:6: sweep.start_offset_m lists 0.0 twice"},
      {with("points = [3, 5]",
            "points = { from = 3, to = 1000, step = 1 }\nrange_sigma_m = { from = 0.001, to = 1.003, step = 0.001 }"),
       "demo.toml:5: [sweep] crosses to 1000994 cells; at most 1000000 are allowed"},
  }));
  const std::string error = error_of(text);
  INFO(text << "\n-> " << error);
  CHECK(error.find(message) != std::string::npos);
  CHECK(error.find('\n') == std::string::npos);
}

TEST_CASE("zipped axes count as one among the cells of a sweep") {
  const Study study = read(with("points = [3, 5]",
                                "points = { from = 3, to = 103, step = 1 }\n"
                                "range_sigma_m = { from = 0.1, to = 10.1, step = 0.1 }\n"
                                "start_offset_m = { from = 0, to = 10, step = 0.1 }\n"
                                "zip = [[\"points\", \"range_sigma_m\", \"start_offset_m\"]]"));
  CHECK(make_plan(study).cells.size() == 101);
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

TEST_CASE("a text with what a terminal takes for a command is refused, one of several lines is not") {
  const auto titled = [](const std::string& title) {
    return tests::error_of("title = " + title + "\n" + tests::valid);
  };
  for (const char* title : {"\"\\u001b]0;x\\u0007\"", "\"a\\rb\"", "\"\\u009b31m\"", "\"\\u0000\""})
    CHECK(titled(title) == "demo.toml:1: title holds a control character; leave it out");
  CHECK(titled("\"\"\"\r\na\r\n\tb\"\"\"").empty());
  // What is called after its file is shown without them.
  CHECK(read_study({"a\x1b", "a.toml", tests::valid}).title == "a?");
}
