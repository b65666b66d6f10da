#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/schema/schema.hpp"

namespace ridgeloc::results {

/// A text without blanks around it.
std::string_view trimmed(std::string_view text);

/// The items between commas that do not stand in brackets, trimmed: "[1,5], [1,10]" has two, as "max(a, b), c" has.
std::vector<std::string_view> list_items(std::string_view text);

/// Adds what a text names: "range_sigma_m=0.1,0.3", also "depth_m=[1,5],[1,10]". Throws core::InputError where there is
/// no axis or no value.
void add_axis_values(AxisValues& chosen, std::string_view text);

/// Texts that `add_axis_values` reads, one per axis.
std::vector<std::string> axis_values_texts(const AxisValues& chosen);

/// The number that a text is, as a whole; nothing else. "inf" and "nan" are such texts.
std::optional<double> number_in(std::string_view text);

/// Whether a text writes the value: numbers are compared by value, alone and in intervals, so that 0.10 is 0.1.
bool is_written_as(const FactorValue& value, std::string_view text);

}  // namespace ridgeloc::results
