#pragma once

#include <cstddef>
#include <vector>

#include "results/figures/figure_data.hpp"
#include "results/figures/figure_layout.hpp"

namespace ridgeloc::results {

/// x of the error bars of a panel, by line and point. Marks and lines stand at the true x, and so does a bar, but where
/// bars that are longer than a mark overlap: these stand beside each other by less than the width of a line, and none
/// leaves its mark.
std::vector<std::vector<double>> bar_places(const FigureData& data, const FigureLayout& layout, std::size_t panel);

}  // namespace ridgeloc::results
