// Any text as a file of samples or positions.

#include <cmath>

#include "studies/files/csv_columns.hpp"
#include "tests/fuzz/refused.hpp"

using namespace ridgeloc;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::size_t most = 100;
  tests::is_refused([&] {
    const auto columns = studies::columns_in(tests::text_of(data, size), "fuzz.csv", {"x_m", "e"}, most);
    if (columns.size() != 2 || columns[0].size() != columns[1].size() || columns[0].size() > most) __builtin_trap();
    for (const auto& column : columns)
      for (const double value : column)
        if (!std::isfinite(value)) __builtin_trap();
  });
  return 0;
}
