#include "core/elementary.hpp"
#include "tests/core/pack_measurements.hpp"
#include "tests/support/catch.hpp"

using namespace ridgeloc;

namespace {

void check(const tests::PackMeasurements& m) {
  CAPTURE(m.lanes, m.log_error_ulp, m.exp_error_ulp, m.exp_minus_one_error_ulp, m.sin_cos_error,
          m.inverse_cube_root_error_ulp);
  CHECK(m.wrong_roots == 0);
  CHECK(m.wrong_reciprocals == 0);
  CHECK(m.wrong_root_inverses == 0);
  CHECK(m.wrong_specials == 0);
  CHECK(m.seed_dependent == 0);
  CHECK(m.wrong_products == 0);
  CHECK(m.wrong_words == 0);
  CHECK(m.wrong_columns == 0);
  CHECK(m.wrong_masks == 0);
  CHECK(m.dependent_eigens == 0);
  CHECK(m.log_error_ulp <= core::log_max_error_ulp);
  CHECK(m.exp_error_ulp <= core::exp_max_error_ulp);
  CHECK(m.exp_minus_one_error_ulp <= core::exp_minus_one_max_error_ulp);
  CHECK(m.sin_cos_error <= core::sin_cos_max_error);
  CHECK(m.inverse_cube_root_error_ulp <= core::inverse_cube_root_max_error_ulp);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("packs compute what they should", "", ((core::Isa isa), isa), core::Isa::Baseline,
                       core::Isa::Avx2, core::Isa::Avx512) {
  // Else there is nothing to measure: this build has no such packs, or this processor cannot run them.
  if constexpr (core::has_kernels(isa)) {
    if (core::is_supported(isa)) check(tests::measure_packs<isa>());
  }
}
