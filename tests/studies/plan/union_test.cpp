#include "studies/plan/union.hpp"

#include <set>

#include "studies/files/study_reader.hpp"
#include "studies/files/study_writer.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;

namespace {

Study study(const std::string& text, const std::string& name = "s") {
  return read_study({name, name + ".toml", "experiment = \"ranging\"\n" + text});
}

const std::string ols_alone = "[[method]]\nsolver = \"ols\"\n";

template <class Info>
std::set<std::string> hashes(const std::vector<Info>& list) {
  std::set<std::string> set;
  for (const Info& info : list) set.insert(info.hash);
  return set;
}

/// Whether a study has every cell and method of another, also after it has been written and read again.
bool covers(const Study& all, const Study& part) {
  const Plan wide = make_plan(read_study({"w", "w.toml", resolved_toml(all)}));
  const Plan narrow = make_plan(part);
  return std::ranges::includes(hashes(wide.header.cells), hashes(narrow.header.cells)) &&
         std::ranges::includes(hashes(wide.header.methods), hashes(narrow.header.methods)) &&
         wide.header.study_hash == narrow.header.study_hash && wide.header.trials >= narrow.header.trials;
}

std::string refusal(const Study& a, const Study& b) {
  return tests::refusal_of([&] { united(a, b); });
}

}  // namespace

TEST_CASE("the union of two studies has all cells, methods and trials of both, and the face of the first") {
  const Study a = study("title = \"A\"\ntrials = 100\n[sweep]\npoints = [3, 7]\nrange_sigma_m = [0.1]\n" + ols_alone);
  const Study b = study("title = \"B\"\ntrials = 500\n[sweep]\npoints = [5, 3]\nrange_sigma_m = [0.3, 0.1]\n" +
                        ols_alone + "[[method]]\nsolver = \"rr\"\n");
  for (const Study& all : {united(a, b), united(b, a)}) {
    CHECK(covers(all, a));
    CHECK(covers(all, b));
    CHECK(all.methods.size() == 2);
  }
  CHECK(united(a, b).title == "A");
  CHECK(resolved_toml(united(a, a)) == resolved_toml(a));
}

TEST_CASE("values that ascend stay so; others keep the order of the first study") {
  const auto values = [](const std::string& a, const std::string& b) {
    const auto sweep = [](const std::string& list) { return study("[sweep]\npoints = " + list + "\n" + ols_alone); };
    std::vector<std::int64_t> numbers;
    const Study all = united(sweep(a), sweep(b));
    for (const Value& value : all.sweep.front().values) numbers.push_back(std::get<std::int64_t>(value));
    return numbers;
  };
  CHECK(values("[3, 7]", "[4, 7, 9]") == std::vector<std::int64_t>{3, 4, 7, 9});
  CHECK(values("[7, 3]", "[4, 7, 9]") == std::vector<std::int64_t>{7, 3, 4, 9});
}

TEST_CASE("zipped axes gain whole rows, and must be zipped alike") {
  const auto zipped = [](const std::string& points, const std::string& sigma) {
    return study("[sweep]\npoints = " + points + "\nrange_sigma_m = " + sigma +
                 "\nzip = [[\"points\", \"range_sigma_m\"]]\n" + ols_alone);
  };
  const Study a = zipped("[3, 4]", "[0.1, 0.2]");
  const Study b = zipped("[5, 3]", "[0.3, 0.1]");
  const Study all = united(a, b);
  CHECK(covers(all, a));
  CHECK(covers(all, b));
  CHECK(make_plan(all).cells.size() == 3);
  CHECK(refusal(a, study("[sweep]\npoints = [3]\nrange_sigma_m = [0.1]\n" + ols_alone)).find("zip") !=
        std::string::npos);
  // A value may stand beside several of the other axis.
  const Study c = zipped("[5, 3]", "[0.3, 0.2]");
  CHECK(covers(united(a, c), a));
  CHECK(covers(united(a, c), c));
  CHECK(make_plan(united(a, c)).cells.size() == 4);
}

TEST_CASE("an exclusion stays only if neither study has what it leaves out") {
  const auto with = [](const std::string& exclude) {
    return study("[sweep]\npoints = [3, 4, 5]\nrange_sigma_m = [0.1, 0.2]\nexclude = [" + exclude + "]\n" + ols_alone);
  };
  const Study a = with("{ points = 3, range_sigma_m = 0.1 }, { points = 5 }");
  const Study b = with("{ points = 3, range_sigma_m = 0.1 }");
  for (const Study& all : {united(a, b), united(b, a)}) {
    CHECK(covers(all, b));
    CHECK(make_plan(all).cells.size() == 5);
  }
}

TEST_CASE("a method that relied on shared settings keeps them when they differ") {
  const Study a = study("[solver]\nmax_iterations = 20\n[[method]]\nsolver = \"ols\"\n");
  const Study b = study("[solver]\nmax_iterations = 50\n[[method]]\nsolver = \"lm\"\n");
  const Study all = united(a, b);
  CHECK(covers(all, a));
  CHECK(covers(all, b));
  CHECK(make_plan(all).header.methods[1].hash == make_plan(b).header.methods[0].hash);
}

TEST_CASE("one name for two methods is refused") {
  const Study a = study("[solver]\nmax_iterations = 20\n" + ols_alone, "a");
  const Study b = study("[solver]\nmax_iterations = 50\n" + ols_alone, "b");
  const std::string message = refusal(a, b);
  CHECK(message.find("a: its method \"ols\" has other settings in b") != std::string::npos);
  // The same method under another name is the same method.
  const Study renamed = study("[[method]]\nsolver = \"ols\"\nname = \"Gauss\"\n");
  CHECK(united(renamed, study(ols_alone)).methods.size() == 1);
}

TEST_CASE("differences name each key that changes every number, and no other") {
  const Study a = study("seed = 1\n[scene]\ndepth_m = [1, 5]\npoints = 4\n" + ols_alone);
  const Study b = study(
      "seed = 2\ntrials = 7\n[scene]\ndepth_m = [1, 9]\n[solver]\nmax_iterations = 9\n[sweep]\npoints = [3, 4]\n" +
      ols_alone);
  CHECK(differences(a, b) == std::vector<std::string>{"depth_m is [1.0, 5.0], not [1.0, 9.0]", "points is 4, not swept",
                                                      "seed is 1, not 2"});
  CHECK(differences(a, a).empty());
}

TEST_CASE("a union of more cells than a study may have is refused, and so is its plan") {
  const auto sweep = [](const std::string& points, const std::string& sigma) {
    return study("[sweep]\npoints = " + points + "\nrange_sigma_m = " + sigma + "\n" + ols_alone);
  };
  const Study wide = sweep("{ from = 3, to = 1000, step = 1 }", "{ from = 0.001, to = 1, step = 0.001 }");
  const std::string expected =
      "s: its sweep crosses to 1000994 cells; at most 1000000 are allowed, so cut it in pieces";
  CHECK(refusal(wide, sweep("[3]", "[2, 3, 4]")) == expected);
  Study all = wide;
  all.sweep[1].values.insert(all.sweep[1].values.end(), {2.0, 3.0, 4.0});
  CHECK(tests::refusal_of([&] { make_plan(all); }) == expected);
}
