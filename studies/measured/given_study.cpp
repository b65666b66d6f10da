#include "studies/measured/given_study.hpp"

#include <fmt/format.h>

#include <cmath>
#include <ostream>

#include "core/error.hpp"
#include "results/tables/csv_writer.hpp"
#include "studies/files/study_writer.hpp"

namespace ridgeloc::studies {

namespace {

/// What studies take of samples and of positions.
constexpr std::size_t most_errors = 100'000;
constexpr std::size_t most_places = 100'000;

Positions from(const Place& origin, std::span<const Place> places) {
  std::vector<Place> out;
  for (const Place& place : places) out.push_back({place[0] - origin[0], place[1] - origin[1], place[2] - origin[2]});
  return Positions(out);
}

}  // namespace

void GivenStudy::add(const Epoch& epoch, const Fix& fix, bool knows_height) {
  if (fix.status != core::status_names[0]) return;
  const std::size_t unknowns = knows_height ? 2 : 3;
  const std::size_t readings = fix.residuals_m.size();
  if (readings > unknowns) {
    const double growth = std::sqrt(static_cast<double>(readings) / static_cast<double>(readings - unknowns));
    for (const double residual : fix.residuals_m) add_error(residual * growth);
  }
  for (const Reading& reading : epoch.readings)
    if (objects_.size() <= most_places) objects_.insert(reading.at);
  if (places_.size() < most_places) places_.push_back(*fix.position);
}

void GivenStudy::add_error(double error_m) {
  if (offered_++ % stride_ != 0) return;
  errors_m_.push_back(error_m);
  if (errors_m_.size() <= most_errors) return;
  // Every second one, from now on too.
  for (std::size_t i = 0; 2 * i < errors_m_.size(); ++i) errors_m_[i] = errors_m_[2 * i];
  errors_m_.resize((errors_m_.size() + 1) / 2);
  stride_ *= 2;
}

void GivenStudy::write_noise(std::ostream& out) const {
  results::CsvWriter csv(out, results::DecimalMark::Point);
  csv.text("error_m");
  csv.end_line();
  for (const double error : errors_m_) {
    csv.number(error);
    csv.end_line();
  }
  csv.flush();
}

void GivenStudy::write_scene(std::ostream& out, Study study) const {
  if (places_.empty()) throw core::InputError("no epoch has an answer that converged: there is no place for a scene");
  if (objects_.size() > most_places)
    throw core::InputError(
        fmt::format("more than {} different objects, which are all that a scene may have", most_places));
  const std::vector<Place> objects(objects_.begin(), objects_.end());
  const Place& origin = objects.front();
  double squares = 0.0;
  for (const double error : errors_m_) squares += error * error;
  study.title = "Own places";
  study.fixed["objects"] = std::string("given");
  study.fixed["objects_m"] = from(origin, objects);
  study.fixed["camera_m"] = from(origin, places_);
  if (!errors_m_.empty()) study.fixed["range_sigma_m"] = std::sqrt(squares / static_cast<double>(errors_m_.size()));
  out << fmt::format("# Coordinates are taken from [{}, {}, {}].\n", origin[0], origin[1], origin[2])
      << resolved_toml(study);
}

}  // namespace ridgeloc::studies
