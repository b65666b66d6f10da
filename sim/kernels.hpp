#pragma once

#include "core/isa.hpp"
#include "sim/field_of_view.hpp"
#include "sim/given_scene.hpp"
#include "sim/images.hpp"
#include "sim/range_noise.hpp"
#include "sim/scores.hpp"

namespace ridgeloc::sim {

/// Scenes, scores, noise and images, compiled for one instruction set: the same functions as the templates of these
/// names.
struct Kernels {
  decltype(&place_objects<double>) place_objects;
  decltype(&place_camera<double>) place_camera;
  decltype(&show_map<double>) show_map;
  decltype(&draw_scores<double>) draw_scores;
  decltype(&measure_ranges<double>) measure_ranges;
  decltype(&take_images<double>) take_images;
};

/// The kernels over a number type.
template <class Real>
Kernels kernels_over() {
  return {place_objects<Real>, place_camera<Real>,   show_map<Real>,
          draw_scores<Real>,   measure_ranges<Real>, take_images<Real>};
}

/// Those of one instruction set, each defined in a source file that is compiled for it.
template <core::Isa isa>
Kernels kernels();

template <>
Kernels kernels<core::Isa::Baseline>();
template <>
Kernels kernels<core::Isa::Avx2>();
template <>
Kernels kernels<core::Isa::Avx512>();

/// Precondition: core::is_supported(isa).
Kernels kernels(core::Isa isa);

}  // namespace ridgeloc::sim
