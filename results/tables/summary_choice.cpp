#include "results/tables/summary_choice.hpp"

#include <algorithm>
#include <numeric>

namespace ridgeloc::results {

SummaryChoice whole(const Header& header) {
  SummaryChoice all;
  all.cells.resize(header.cells.size());
  std::iota(all.cells.begin(), all.cells.end(), std::size_t{0});
  all.methods.resize(header.methods.size());
  std::iota(all.methods.begin(), all.methods.end(), std::size_t{0});
  return all;
}

std::vector<std::size_t> methods_labelled(const Header& header, const std::vector<std::string>& labels) {
  const auto is_named = [&](std::size_t method) {
    return std::ranges::find(labels, header.methods[method].label) != labels.end();
  };
  std::vector<std::size_t> methods;
  for (std::size_t m = 0; m < header.methods.size(); ++m) {
    const auto& difference = header.methods[m].difference;
    if (is_named(m) || (difference && is_named((*difference)[0]) && is_named((*difference)[1]))) methods.push_back(m);
  }
  return methods;
}

}  // namespace ridgeloc::results
