#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <optional>
#include <string_view>
#include <vector>

#include "app/exit_code.hpp"
#include "app/instruction_set.hpp"
#include "app/name_choice.hpp"
#include "app/output.hpp"
#include "app/verbs.hpp"
#include "core/error.hpp"
#include "core/printable.hpp"
#include "results/util/file_system.hpp"
#include "studies/files/study_reader.hpp"
#include "studies/measured/epoch_reader.hpp"
#include "studies/measured/fix_writer.hpp"
#include "studies/measured/given_study.hpp"
#include "studies/registry.hpp"
#include "studies/study/capabilities.hpp"

namespace ridgeloc::app {

namespace {

/// Epochs that are solved together.
constexpr std::size_t epochs_at_once = 512;

/// Complaints about readings that are printed; the others are counted.
constexpr std::size_t most_complaints = 10;

/// A study without a scene: measured data have their own. Iterated to a millimetre, since nobody counts the steps.
std::string text_of_solvers(std::vector<std::string> solvers) {
  if (solvers.empty()) solvers = {"lm"};
  const auto known = studies::solvers_of(*studies::find_experiment("ranging"));
  std::string text =
      "experiment = \"ranging\"\n[solver]\nstep_tolerance_m = 1e-3\nmax_iterations = 200\nstart = \"linear\"\n";
  for (const std::string& solver : solvers) {
    check_name("--solver", solver, known);
    text += fmt::format("[[method]]\nsolver = \"{}\"\n", solver);
  }
  return text;
}

studies::Study study_of(const SolveOptions& options) {
  if (options.study.empty()) {
    return studies::read_study({"measured", "the methods asked for", text_of_solvers(options.solvers)},
                               options.overrides);
  }
  if (!options.solvers.empty()) throw core::InputError("--solver and --study both say the methods; give one of them");
  return studies::read_study(studies::find_study(options.study), options.overrides);
}

/// Opens a file, or standard input for "-".
std::istream& open(const std::string& path, std::ifstream& file) {
  if (path == "-") return std::cin;
  file.open(path, std::ios::binary);
  file.peek();  // a folder opens, and fails here
  if (!file.is_open() || file.bad()) throw core::InputError(path + ": cannot be read; is it there, and yours to read?");
  file.clear();
  return file;
}

studies::DataColumns columns_of(const std::vector<std::string>& renamed) {
  studies::DataColumns columns;
  const std::vector<std::pair<std::string_view, std::string*>> roles = {
      {"epoch", &columns.epoch}, {"object", &columns.object}, {"range", &columns.range}, {"score", &columns.score},
      {"x", &columns.x},         {"y", &columns.y},           {"z", &columns.z}};
  for (const std::string& item : renamed) {
    const auto equals = item.find('=');
    const auto role = std::ranges::find(roles, std::string_view(item).substr(0, equals),
                                        &std::pair<std::string_view, std::string*>::first);
    if (equals == std::string::npos || role == roles.end()) {
      throw core::InputError(fmt::format(
          "--column {}: write ROLE=NAME, where ROLE is epoch, object, range, score, x, y or z, for example range=dist",
          item));
    }
    *role->second = item.substr(equals + 1);
  }
  return columns;
}

double metres_of(const std::string& unit) {
  constexpr std::array<std::pair<std::string_view, double>, 5> units = {
      {{"m", 1.0}, {"cm", 0.01}, {"mm", 0.001}, {"km", 1000.0}, {"ft", 0.3048}}};
  return std::ranges::find(units, unit, &std::pair<std::string_view, double>::first)->second;
}

void refuse_overwriting(const std::string& input, const std::string& output) {
  std::error_code failure;
  if (!output.empty() && std::filesystem::is_regular_file(input, failure) &&
      std::filesystem::equivalent(input, output, failure))
    throw core::InputError(output + ": is read, and would be written over; choose another name");
}

/// Says what is left out, or refuses it.
class Complaints {
 public:
  explicit Complaints(bool is_strict) : is_strict_(is_strict) {}

  void operator()(const std::string& message) {
    if (is_strict_) throw core::InputError(message);
    if (++count_ <= most_complaints) say(fmt::format("ridgeloc: {}\n", core::printable(message)));
  }

  void conclude() const {
    if (count_ > most_complaints) say(fmt::format("ridgeloc: and {} more such lines\n", count_ - most_complaints));
    if (count_ > 0) say("ridgeloc: readings that cannot be used are left out; --strict refuses such data\n");
  }

 private:
  bool is_strict_;
  std::size_t count_ = 0;
};

}  // namespace

int solve(const SolveOptions& options) {
  if (options.data == "-" && options.objects == "-")
    throw core::InputError("DATA and --objects cannot both be standard input");
  for (const std::string& output : {options.output, options.noise, options.scene})
    for (const std::string& input : {options.data, options.objects}) refuse_overwriting(input, output);
  if (!options.scene.empty() && results::path_exists(options.scene))
    throw core::InputError(options.scene + ": exists already; choose another --as-scene or remove it");
  const studies::Study study = study_of(options);
  studies::EpochSolver solver(study, {options.start, options.sigma_m}, instruction_set(options.isa));

  studies::DataFormat format{columns_of(options.columns), metres_of(options.range_unit),
                             metres_of(options.position_unit)};
  studies::ObjectTable objects;
  if (!options.objects.empty()) {
    std::ifstream file;
    objects =
        studies::read_objects(open(options.objects, file), options.objects, format.columns, format.position_unit_m);
  }
  std::ifstream file;
  Complaints complaints(options.is_strict);
  studies::EpochReader reader(open(options.data, file), options.data == "-" ? "standard input" : options.data, format,
                              objects, [&](const std::string& message) { complaints(message); });

  studies::GivenStudy given;
  const bool collects = !options.noise.empty() || !options.scene.empty();
  write_output(options.output, [&](std::ostream& out) {
    const auto writer =
        options.json ? studies::json_fix_writer(out) : studies::csv_fix_writer(out, results::DecimalMark::Point);
    std::vector<studies::Epoch> epochs;
    std::vector<studies::EpochGeometry> geometries;
    for (bool more = true; more;) {
      epochs.clear();
      geometries.clear();
      studies::Epoch epoch;
      while (epochs.size() < epochs_at_once && (more = reader.next(epoch))) {
        geometries.push_back(studies::geometry_of_epoch(epoch, solver.knows_height()));
        epochs.push_back(epoch);
      }
      const auto fixes = solver.solve(epochs, geometries);
      for (std::size_t e = 0; e < epochs.size(); ++e) {
        for (std::size_t m = 0; m < solver.methods(); ++m)
          writer->write(epochs[e], geometries[e], solver.label(m), fixes[m][e]);
        if (collects) given.add(epochs[e], fixes[0][e], solver.knows_height());
      }
      writer->flush();
    }
  });
  complaints.conclude();
  if (!options.noise.empty()) {
    if (given.errors() == 0)
      throw core::InputError(
          "--as-noise: no epoch with an answer has more ranges than unknowns, so that nothing is left over");
    write_output(options.noise, [&](std::ostream& out) { given.write_noise(out); });
  }
  if (!options.scene.empty()) write_output(options.scene, [&](std::ostream& out) { given.write_scene(out, study); });
  return Success;
}

}  // namespace ridgeloc::app
