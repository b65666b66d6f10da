#include <algorithm>
#include <filesystem>
#include <fstream>

#include "sim/range_noise.hpp"
#include "studies/files/study_writer.hpp"
#include "studies/plan/plan.hpp"
#include "studies/registry.hpp"
#include "tests/support/catch.hpp"
#include "tests/support/message_of.hpp"
#include "tests/support/scratch_folder.hpp"
#include "tests/support/valid_study.hpp"

using namespace ridgeloc;
using namespace ridgeloc::studies;
using tests::error_of;
using tests::read;
using tests::with;
namespace fs = std::filesystem;

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
    return samples("{ file = \"" + name + "\", column = \"" + column + "\" }");
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
    const std::string error = tests::refusal_of([&, study = text] {
      read_study({"demo", folder + "demo.toml", study});
    });
    INFO(text << "\n-> " << error);
    CHECK(error.find(message) != std::string::npos);
    CHECK(error.find('\n') == std::string::npos);
  }
}

TEST_CASE("a study names no file outside of its folder, the command line any") {
  const Residuals residuals;
  const fs::path folder = residuals.folder / "inner";
  fs::create_directory(folder);
  fs::create_symlink(residuals.folder / "residuals.csv", folder / "link.csv");
  fs::copy_file(residuals.folder / "residuals.csv", residuals.folder / "inner.csv");
  const auto error_of_file = [&](const std::string& name, const std::string& origin) {
    const std::string study = samples("{ file = \"" + name + "\", column = \"e_m\" }");
    return tests::refusal_of([&] { read_study({"demo", origin, study}); });
  };
  const std::string origin = (folder / "demo.toml").string();
  const std::string outside = (residuals.folder / "residuals.csv").string();
  for (const std::string& name : {outside, std::string("../residuals.csv"), std::string("link.csv"),
                                  std::string("../inner.csv"), std::string("../inner/../residuals.csv")}) {
    const std::string error = error_of_file(name, origin);
    INFO(name << ": " << error);
    CHECK(tests::lacking(error, {"demo.toml:5: noise.noise_samples.file: ",
                                 " lies neither beside the study nor below; "
                                 "move it there, or name it on the command line, with --set"}) == "");
  }
  // A folder of which nobody can say where it is has nothing inside.
  fs::create_symlink("loop", residuals.folder / "loop");
  CHECK(tests::lacking(error_of_file("own.csv", (residuals.folder / "loop" / "demo.toml").string()),
                       {" lies neither beside the study nor below"}) == "");
  fs::copy_file(residuals.folder / "residuals.csv", folder / "own.csv");
  CHECK(error_of_file("own.csv", origin).empty());
  CHECK(error_of_file("./own.csv", origin).empty());
  CHECK(error_of_file((folder / "own.csv").string(), origin).empty());
  CHECK(error_of_file("inner/own.csv", (residuals.folder / "demo.toml").string()).empty());
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
