#pragma once

#include <cstddef>

#include "core/isa.hpp"

namespace ridgeloc::tests {

/// What the packs of one instruction set do, against the standard library and Random123, over many values in all lanes.
struct PackMeasurements {
  std::size_t lanes = 0;
  std::size_t wrong_roots = 0;        ///< not the correctly rounded square root
  std::size_t wrong_reciprocals = 0;  ///< not the correctly rounded 1 / x
  std::size_t wrong_root_inverses = 0;
  std::size_t wrong_specials = 0;  ///< of zero, infinity, negative numbers and NaN
  std::size_t seed_dependent = 0;  ///< refined values that are not correctly rounded from some seed
  std::size_t wrong_products = 0;  ///< mul_add and neg_mul_add neither fused nor twice rounded
  std::size_t wrong_words = 0;     ///< random words that are not Random123's
  std::size_t wrong_columns = 0;   ///< loads and stores at the end of a column
  std::size_t wrong_masks = 0;
  std::size_t dependent_eigens = 0;  ///< eigenvalues and eigenvectors that depend on those in other lanes
  double log_error_ulp = 0.0;
  double exp_error_ulp = 0.0;
  double exp_minus_one_error_ulp = 0.0;
  double sin_cos_error = 0.0;  ///< absolute, in 2^-53
  double inverse_cube_root_error_ulp = 0.0;
};

/// Each defined in a source file that is compiled for the instruction set. Precondition: core::is_supported(isa).
template <core::Isa isa>
PackMeasurements measure_packs();
template <>
PackMeasurements measure_packs<core::Isa::Baseline>();
template <>
PackMeasurements measure_packs<core::Isa::Avx2>();
template <>
PackMeasurements measure_packs<core::Isa::Avx512>();

}  // namespace ridgeloc::tests
