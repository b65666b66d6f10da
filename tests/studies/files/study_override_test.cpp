#include "tests/support/catch.hpp"
#include "tests/support/valid_study.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using tests::error_of;
using tests::read;
using tests::valid;

TEST_CASE("overrides replace, add and reach into tables and methods") {
  const Study study = read(valid, {"scene.depth_m=[1, 3]", "trials=77", "noise.range_sigma_m=0.25",
                                   "method.0.k=kibria_gm", "sweep.points=[4]"});
  CHECK(std::get<Interval>(study.fixed.at("depth_m")) == Interval{1, 3});
  CHECK(study.trials == 77);
  CHECK(std::get<double>(study.fixed.at("range_sigma_m")) == 0.25);
  CHECK(std::get<std::string>(study.methods[0].given.at("k")) == "kibria_gm");
  CHECK(study.sweep[0].values == std::vector<Value>{std::int64_t{4}});
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

TEST_CASE("a bad override is named as it was given") {
  CHECK(error_of(valid, {"scene.depth_m=[2,1]"}).starts_with("--set scene.depth_m=[2,1]: scene.depth_m = [ 2, 1 ]"));
  CHECK(error_of(valid, {"scene.dept_m=1"}).starts_with("--set scene.dept_m=1: unknown key \"dept_m\" in [scene]"));
  CHECK(error_of(valid, {"trials"}) == "--set trials: expected KEY=VALUE, for example scene.depth_m=[2,15]");
  CHECK(error_of(valid, {"method.3.k=fixed"}).starts_with("--set method.3.k=fixed: \"3\" is not a position"));
  CHECK(error_of(valid, {"foo.bar=1"}).starts_with("--set foo.bar=1: unknown key \"foo\" in the study"));
  CHECK(error_of(valid, {"seed=1\ntrials=5"}).find("expected one KEY=VALUE") != std::string::npos);
  CHECK(error_of(valid, {"trials.x=1"}).starts_with("--set trials.x=1: "));
}
