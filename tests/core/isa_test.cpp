#include "core/isa.hpp"

#include "tests/support/catch.hpp"

using namespace ridgeloc::core;

TEST_CASE("instruction sets go by their names") {
  for (std::size_t i = 0; i < isa_count; ++i) {
    const Isa isa = static_cast<Isa>(i);
    CHECK(find_isa(name_of(isa)) == isa);
  }
  CHECK_FALSE(find_isa("sse9").has_value());
}

TEST_CASE("the baseline is always there, and the best one is") {
  CHECK(is_supported(Isa::Baseline));
  CHECK(is_supported(best_isa()));
  CHECK((!is_supported(Isa::Avx512) || best_isa() == Isa::Avx512));
}
