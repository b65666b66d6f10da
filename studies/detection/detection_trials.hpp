#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "core/stream.hpp"
#include "sim/photo.hpp"
#include "studies/photos/building_settings.hpp"

namespace ridgeloc::studies {

/// Settings of the `detection` experiment: those of photos and of the detector, and section object.
std::span<const Setting> detection_experiment_settings();

/// The choice of every class.
inline constexpr std::string_view any_class = "any";

/// Which objects count.
enum class Distance { Any, Near, Far };
inline constexpr std::array<std::string_view, 3> distance_names = {"any", "near", "far"};

struct DetectionCell {
  explicit DetectionCell(const Values& values);

  bool counts(const sim::View& view) const;

  PhotoCell photo;
  std::string class_name;
  Distance distance;
  std::size_t least_detections;
};

/// An object in a photo and what is detected of it.
struct Sighting {
  sim::View view;
  std::optional<sim::Detection> detection;
  double pseudorange_m = 0.0;  ///< of the detection, with the true image distance; NaN without one
};

/// Draws objects in photos. A trial looks through photos, in each at one object at most, until it counts: objects are
/// chosen as often as they are seen, however many a photo shows. The cell must live as long. Thread safe.
class DetectionTrials {
 public:
  DetectionTrials(std::uint64_t seed, const DetectionCell& cell);

  /// Also writes the photo. Nothing where among very many photos none shows what the cell asks for, or one shows more
  /// objects that count than can be told apart.
  std::optional<Sighting> take(std::uint64_t trial, sim::Photo& photo) const;

  /// Whether a photo shows more objects that count than can be told apart, so that `take` has given up.
  bool is_crowded(const sim::Photo& photo) const;

 private:
  const sim::View* find_object(std::uint64_t trial, sim::Photo& photo) const;

  const DetectionCell& cell_;
  sim::PhotoTaker taker_;
  core::Stream choice_;
  std::size_t slots_;
};

}  // namespace ridgeloc::studies
