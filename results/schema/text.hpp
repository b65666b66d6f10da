#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// A factor value as people write it: 3, 0.1, street.
std::string factor_text(const FactorValue& value);

/// A double in its shortest form that reads back as the same bits; nan, inf, -inf.
std::string exact_text(double value);

/// "1 cell", "4 cells".
std::string count_text(std::uint64_t count, std::string_view what);

/// digit * 10^power, correctly rounded: 0 or infinity where a double cannot hold it.
double decimal_number(double digit, int power);

/// "points = 3, range_sigma_m = 0.1"; empty for a study without a sweep.
std::string cell_text(const Header& header, std::size_t cell);

/// "0.1352 ± 0.0012": the error to two significant digits, the value to the same decimal. "?" stands for an
/// error that is not known, "-" for a value that is not.
std::string text_with_error(double value, double error);

/// "0.1352(12)": the error in units of the value's last digit, to two significant digits; "1.352(12)e-09" where that is
/// shorter. "2.5(?)" where the error is not known, "2.5" where there is none, "-" for a value that is not known.
std::string text_with_digits(double value, double error);

/// "0.970 [0.915, 0.990]", to the second significant digit of half the interval's width; "0.97 [?]" where the interval
/// is not known.
std::string text_with_interval(double value, double lo, double hi);

/// Columns that UTF-8 text takes on a terminal, for text without wide or combining characters.
std::size_t display_width(std::string_view text);

}  // namespace ridgeloc::results
