// Any text as a choice of cells (--cell) or of the value of an axis (--against).

#include <limits>

#include "results/summary/cell_comparison.hpp"
#include "studies/plan/cell_choice.hpp"
#include "tests/fuzz/refused.hpp"

using namespace ridgeloc;

namespace {

/// Axes of every kind, crossed.
results::Header header_of_all_kinds() {
  results::Header header;
  header.axes = {
      {"points", "1", "", {std::int64_t{3}, std::int64_t{-5}, std::numeric_limits<std::int64_t>::max()}},
      {"range_sigma_m", "m", "", {0.1, 0.3, 1e-310, 1e300}},
      {"noise_model", "1", "", {std::string("normal"), std::string("[1.0, 2.0]"), std::string("a,b=c")}},
  };
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 4; ++j)
      for (std::size_t k = 0; k < 3; ++k) header.cells.push_back({"", {i, j, k}});
  return header;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const results::Header header = header_of_all_kinds();
  const std::string text = tests::text_of(data, size);
  tests::is_refused([&] {
    for (const std::size_t cell : studies::choose_cells(header, text))
      if (cell >= header.cells.size()) __builtin_trap();
  });
  tests::is_refused([&] { results::axis_value(header, text); });
  return 0;
}
