// Formulas of K in studies: k = "expr" with k_expr.

#include <algorithm>
#include <string>

#include "studies/files/study_writer.hpp"
#include "studies/listing.hpp"
#include "studies/plan/union.hpp"
#include "studies/solving/solver_settings.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/valid_study.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using tests::error_of;
using tests::read;

namespace {

/// A study with these lines in its one [[method]], line 4 and on.
std::string method(const std::string& lines) {
  return "experiment = \"ranging\"\n[[method]]\nsolver = \"rr\"\n" + lines;
}

const std::string formula = "k = \"expr\"\nk_expr = \"sigma2 * trace / n\"\n";

std::string content_of(const Study& study, std::size_t index = 0) {
  return make_plan(study).header.methods[index].description;
}

}  // namespace

TEST_CASE("a method may have a formula of K, which is part of what it is") {
  const Study study = read(method(formula));
  CHECK(study.methods[0].label == "rr");
  CHECK(content_of(study).find("k = \"expr\", k_fixed = 0.0, k_expr = \"sigma2 * trace / n\"") != std::string::npos);
  const Study other = read(method("k = \"expr\"\nk_expr = \"sigma2 * trace / p\"\n"));
  CHECK(method_hash(study, study.methods[0]) != method_hash(other, other.methods[0]));
  CHECK(make_plan(study).header.study_hash == make_plan(other).header.study_hash);

  const std::string resolved = resolved_toml(study);
  CHECK(resolved_toml(read(resolved)) == resolved);
  CHECK(content_of(read(resolved)) == content_of(study));

  const auto options = solver_options(make_plan(study).cells[0].values, study.methods[0].given);
  CHECK(static_cast<int>(options.k_formula.size) == 5);  // sigma2, trace, their product, n, the quotient
}

TEST_CASE("a name of its own, [solver], --set and the sweep give a formula too") {
  CHECK(read(method(formula + "name = \"mine\"\n")).methods[0].label == "mine");
  const std::string shared =
      "experiment = \"ranging\"\n[solver]\n" + formula + "[[method]]\nsolver = \"rr\"\n[[method]]\nsolver = \"ols\"\n";
  CHECK(read(shared).methods[0].label == "rr");
  CHECK(content_of(read(shared)) == content_of(read(method(formula))));
  CHECK(content_of(read(shared), 1).find("k_expr") == std::string::npos);
  CHECK(content_of(read(method(""), {"method.0.k=expr", "method.0.k_expr=sigma2 * trace / n"})) ==
        content_of(read(method(formula))));

  const Study swept = read(
      "experiment = \"ranging\"\n[sweep]\nk_expr = [\"0\", \"sigma2 / p\"]\n[[method]]\n"
      "solver = \"rr\"\nk = \"expr\"\n");
  CHECK(make_plan(swept).cells.size() == 2);
  CHECK(std::get<std::string>(make_plan(swept).header.axes[0].values[1]) == "sigma2 / p");
  CHECK(resolved_toml(read(resolved_toml(swept))) == resolved_toml(swept));
  // A method that another K is chosen for does not mind.
  const Study both = read(
      "experiment = \"ranging\"\n[sweep]\nk = [\"expr\", \"hkb\"]\n[solver]\nk_expr = \"0.1\"\n"
      "[[method]]\nsolver = \"rr\"\n");
  CHECK(make_plan(both).cells.size() == 2);
}

TEST_CASE("a number is a formula, in a study and on a command line") {
  const Study text = read(method("k = \"expr\"\nk_expr = \"5\"\n"));
  CHECK(content_of(read(method("k = \"expr\"\nk_expr = 5\n"))) == content_of(text));
  CHECK(content_of(read(method(formula), {"method.0.k_expr=5"})) == content_of(text));
  CHECK(content_of(read(method(formula), {"method.0.k_expr=0.25"})).find("k_expr = \"0.25\"") != std::string::npos);
}

TEST_CASE("a method is called after its solver wherever its K is chosen") {
  CHECK(read(method(formula)).methods[0].label == read(method("[solver]\n" + formula)).methods[0].label);
}

TEST_CASE("a formula for all methods that none reads is said") {
  const auto remarks_of = [](const std::string& text) { return make_plan(read(text)).remarks; };
  const std::vector<std::string> unread = {"solver.k_expr changes nothing: it is read only if k is expr"};
  CHECK(remarks_of(method("[solver]\nk_expr = \"n\"\n")) == unread);
  CHECK(remarks_of(method(formula + "[solver]\nk_expr = \"n\"\n")) == unread);
  CHECK(remarks_of(method("[solver]\n" + formula)).empty());
  CHECK(remarks_of(method("[solver]\nk_expr = \"\"\n")).empty());
  CHECK(remarks_of(method("k = \"expr\"\n[solver]\nk_expr = \"n\"\n")).empty());
}

TEST_CASE("estimators and formulas move together, built-in ones with an empty formula") {
  const std::string zipped =
      "[sweep]\nk = [\"kibria_gm\", \"hkb\", \"expr\", \"expr\"]\n"
      "k_expr = [\"\", \"\", \"sigma2 / p\", \"sigma2 / n\"]\nzip = [[\"k\", \"k_expr\"]]\n";
  const Study study = read(method(zipped));
  const Plan plan = make_plan(study);
  REQUIRE(plan.cells.size() == 4);
  CHECK(plan.header.axes[0].values.size() == 3);
  CHECK(plan.header.axes[1].values.size() == 3);
  CHECK(plan.header.cells[3].indices == std::vector<std::size_t>{2, 2});
  CHECK(resolved_toml(read(resolved_toml(study))) == resolved_toml(study));
  std::string swapped = zipped;
  swapped.replace(swapped.find("kibria_gm"), 9, "expr");
  CHECK(error_of(method(swapped)).find("k = \"expr\" needs k_expr: a formula is missing") != std::string::npos);
}

TEST_CASE("methods without a formula are what they were before there were formulas") {
  const std::string before =
      "solver = rr, max_iterations = 30, step_tolerance_m = 0.05, start = \"given\", score_power = \"printed\", "
      "jacobian = \"exact\", sigma_prior_m = 0.1, v_mode = \"free\", col_scale = \"norms\", residual = \"range\", "
      "k = \"kibria_gm\", k_fixed = 0.0, similarity = 1.0, k_error = \"signed\", k_error_draw = \"per_iteration\", "
      "ktrue = \"elem\", eta = \"squared\", ols_mode = \"step\", sigma2_source = \"nonlinear_ms\", "
      "ridge_coords = \"raw\", ridge_anchor = \"current\"";
  CHECK(content_of(read(method(""))) == before);
  CHECK(resolved_toml(read(method(""))).find("k_expr") == std::string::npos);
  // Nor does a formula beside them that others read.
  const Study shared =
      read(method("k = \"kibria_gm\"\n[[method]]\nsolver = \"rrr\"\nk = \"expr\"\n[solver]\n"
                  "k_expr = \"n\"\n"));
  CHECK(content_of(shared) == before);
}

TEST_CASE("studies with other formulas unite") {
  const Study here = read(method(formula));
  const Study there = read(
      "experiment = \"ranging\"\n[solver]\nk = \"expr\"\nk_expr = \"n\"\n[[method]]\nsolver = "
      "\"rrr\"\n[[method]]\nsolver = \"rr\"\nk = \"hkb\"\nname = \"by hkb\"\n");
  for (const Study& all : {united(here, there), united(there, here)}) {
    const Study again = read(resolved_toml(all));
    REQUIRE(again.methods.size() == 3);
    std::vector<std::string> hashes;
    for (const Method& m : again.methods) hashes.push_back(method_hash(again, m));
    CHECK(std::ranges::count(hashes, method_hash(here, here.methods[0])) == 1);
    for (const Method& m : there.methods) CHECK(std::ranges::count(hashes, method_hash(there, m)) == 1);
  }
  const Study changed = read(method("k = \"expr\"\nk_expr = \"n\"\n"));
  CHECK(tests::refusal_of([&] { united(here, changed); }).find("its method \"rr\" has other settings") !=
        std::string::npos);
}

TEST_CASE("a formula over several lines is the one that it is in one line") {
  const Study over_lines = read(method("k = \"expr\"\nk_expr = \"\"\"\n  sigma2 *\n  trace   / n\n\"\"\"\n"));
  const Study in_line = read(method(formula));
  CHECK(method_hash(over_lines, over_lines.methods[0]) == method_hash(in_line, in_line.methods[0]));
  CHECK(resolved_toml(over_lines) == resolved_toml(in_line));
}

TEST_CASE("what is wrong with a formula in a study is said with its place") {
  const auto [text, message] = GENERATE(table<std::string, std::string>({
      {method("k = \"expr\"\nk_expr = \"sigma2 * trac / n\"\n"),
       "demo.toml:5: k_expr = 'sigma2 * trac / n' is not allowed: column 10: there is no \"trac\" (did you mean "
       "\"trace\"?)"},
      {method("k = \"expr\"\nk_expr = \"\"\"\nsigma2 *\n  qqqqqqqqqq\"\"\"\n"),
       "demo.toml:5: k_expr = '''sigma2 * qqqqqqqqqq''' is not allowed: column 10: there is no \"qqqqqqqqqq\" "
       "(allowed: "
       "sigma2, n, p, iteration, trace, squares, alpha, "},
      {method("k = \"expr\"\nk_expr = \"sigma2 / (n - p\"\n"),
       "demo.toml:5: k_expr = 'sigma2 / (n - p' is not allowed: column 10: this \"(\" is not closed"},
      {method("k = \"expr\"\nk_expr = true\n"), "demo.toml:5: k_expr = true is not allowed: k_expr takes a text"},
      {method("k = \"expr\"\n"),
       "demo.toml:4: k = \"expr\" needs k_expr: a formula is missing, for example \"p * sigma2"},
      {method("k = \"expr\"\nk_expr = \"\"\n"), "demo.toml:5: k = \"expr\" needs k_expr: a formula is missing"},
      {method("[solver]\nk = \"expr\"\n"), "demo.toml:2: k = \"expr\" needs k_expr: a formula is missing"},
      {method("k_expr = \"n\"\n"),
       "demo.toml:4: k_expr changes nothing in this [[method]]: it is read only if k is expr"},
      {method("k = \"exp\"\n"), "(did you mean \"expr\"?)"},
      {method("[solver]\nk_expr = \"n +\"\n"), "demo.toml:5: solver.k_expr = 'n +' is not allowed: column 4: "},
      {method("[sweep]\nk_expr = [\"n\", \"m\"]\n"), "demo.toml:5: sweep.k_expr = 'm' is not allowed: column 1: "},
      {method("[sweep]\nk_expr = [\"n\", \"p\"]\n"),
       "demo.toml:4: sweep.k_expr changes nothing: no [[method]] reads it: it is read only if k is expr"},
      {method(formula + "[[method]]\nsolver = \"rr\"\n" + formula),
       "two methods are called \"rr\"; tell them apart with name = \"...\""},
      {"experiment = \"ranging\"\n[[method]]\nsolver = \"ols\"\nk_expr = \"n\"\n",
       "demo.toml:4: unknown key \"k_expr\" in [[method]] with solver \"ols\""},
  }));
  const std::string error = error_of(text);
  INFO(error);
  CHECK(error.find(message) != std::string::npos);
  CHECK(error.find('\n') == std::string::npos);
}

TEST_CASE("the list of estimators has what formulas are made of") {
  const auto entries = list_topic("k");
  for (const char* name : {"expr", "k_expr: sigma2", "k_expr: eigenvalues", "k_expr: geomean(v)", "k_expr: sqrt(x)"}) {
    INFO(name);
    CHECK(std::ranges::count(entries, name, &Listed::name) == 1);
  }
}
