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

TEST_CASE("packs of the baseline compute what they should") {
  check(tests::measure_packs<core::Isa::Baseline>());
}

#if defined(__x86_64__)
TEST_CASE("packs of AVX2 compute what they should") {
  if (!core::is_supported(core::Isa::Avx2)) return;  // this processor has no AVX2
  check(tests::measure_packs<core::Isa::Avx2>());
}

TEST_CASE("packs of AVX-512 compute what they should") {
  if (!core::is_supported(core::Isa::Avx512)) return;  // this processor has no AVX-512
  check(tests::measure_packs<core::Isa::Avx512>());
}
#endif
