#include "studies/measured/given_study.hpp"

#include <sstream>
#include <string>

#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"

using namespace ridgeloc;

namespace {

studies::Epoch epoch_of(std::size_t objects) {
  studies::Epoch epoch;
  for (std::size_t j = 0; j < objects; ++j)
    epoch.readings.push_back({"", {1000.0 + static_cast<double>(j), 2000.0, 3.0}, 1.0, 1.0});
  return epoch;
}

studies::Fix fix_of(const std::string& status, std::vector<double> residuals) {
  studies::Fix fix;
  fix.status = status;
  fix.position = studies::Place{1001.0, 2002.0, 4.0};
  fix.residuals_m = std::move(residuals);
  return fix;
}

studies::Study ranging_study() {
  return studies::read_study({"mine", "mine.toml", "experiment = \"ranging\"\n[[method]]\nsolver = \"rrr\"\n"});
}

}  // namespace

TEST_CASE("errors are residuals made larger by what the fit took from them") {
  studies::GivenStudy given;
  given.add(epoch_of(4), fix_of("converged", {0.5, -1.0, 0.25, 0.0}), false);
  given.add(epoch_of(3), fix_of("converged", {0.0, 0.0, 0.0}), false);  // nothing is left over
  given.add(epoch_of(4), fix_of("iteration_limit", {9.0, 9.0, 9.0, 9.0}), false);
  std::ostringstream out;
  given.write_noise(out);
  CHECK(out.str() == "error_m\n1\n-2\n0.5\n0\n");

  studies::GivenStudy with_height;
  with_height.add(epoch_of(4), fix_of("converged", {1.0, 0.0, 0.0, 0.0}), true);
  std::ostringstream of_two;
  with_height.write_noise(of_two);
  CHECK(of_two.str() == "error_m\n1.4142135623730951\n0\n0\n0\n");
}

TEST_CASE("of more errors than a study takes, as many as it takes are kept, evenly") {
  studies::GivenStudy given;
  for (int i = 0; i < 60'000; ++i) given.add(epoch_of(4), fix_of("converged", {1.0, 2.0, 3.0, 4.0}), false);
  CHECK(given.errors() <= 100'000);
  CHECK(given.errors() > 50'000);
}

TEST_CASE("a scene of measured places is a study that can be read, near its origin") {
  studies::GivenStudy given;
  given.add(epoch_of(4), fix_of("converged", {0.5, -0.5, 0.5, -0.5}), false);
  std::ostringstream out;
  given.write_scene(out, ranging_study());
  CHECK(out.str().starts_with("# Coordinates are taken from [1000, 2000, 3].\n"));
  const auto study = studies::read_study({"scene", "scene.toml", out.str()});
  const auto& objects = std::get<studies::Positions>(study.fixed.at("objects_m"));
  REQUIRE(objects.size() == 4);
  CHECK(objects[3] == studies::Place{3.0, 0.0, 0.0});
  const auto& places = std::get<studies::Positions>(study.fixed.at("camera_m"));
  REQUIRE(places.size() == 1);
  CHECK(places[0] == studies::Place{1.0, 2.0, 1.0});
  CHECK(std::get<double>(study.fixed.at("range_sigma_m")) == 1.0);
  CHECK(study.methods.front().solver == "rrr");
}

TEST_CASE("without an answer there is no scene") {
  std::ostringstream out;
  CHECK(tests::lacking(tests::refusal_of([&] { studies::GivenStudy().write_scene(out, ranging_study()); }),
                       {"no epoch has an answer"}) == "");
}
