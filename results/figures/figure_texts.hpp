#pragma once

#include <string>
#include <vector>

#include "results/figures/figure_names.hpp"
#include "results/schema/schema.hpp"

/// Internal to figures: what is written along their axes and into their legends.
namespace ridgeloc::results {

/// "position error [m]"; without brackets where there is no unit.
std::string with_unit(const std::string& text, const std::string& unit);

/// The description with its unit, or the name where there is none.
std::string axis_label(const Axis& axis);
const std::string& description_of(const FigureNames::Quantity& quantity);

/// Whether two quantities belong on one vertical axis: unit and statistic are the same.
bool share_scale(const FigureNames::Quantity& a, const FigureNames::Quantity& b);

/// The label of the vertical axis of quantities that share it: of one quantity all that it is, of several what they
/// have in common.
std::string scale_label(const std::vector<FigureNames::Quantity>& quantities);

/// Legend texts that tell the quantities apart.
std::vector<std::string> quantity_texts(const std::vector<FigureNames::Quantity>& quantities);

}  // namespace ridgeloc::results
