#include "studies/solving/extent.hpp"

#include <algorithm>
#include <cmath>

#include "core/symmetric_eigen.hpp"

namespace ridgeloc::studies {

namespace {

constexpr double flat = 1e-6;

template <std::size_t Axes>
Extent extent(std::span<const Place> places) {
  Extent out;
  for (const Place& place : places)
    for (std::size_t axis = 0; axis < place.size(); ++axis)
      out.mean[axis] += place[axis] / static_cast<double>(places.size());
  core::Symmetric<double, Axes> scatter;
  for (const Place& place : places)
    for (std::size_t i = 0; i < Axes; ++i)
      for (std::size_t k = i; k < Axes; ++k) scatter(i, k) += (place[i] - out.mean[i]) * (place[k] - out.mean[k]);
  const auto eigen = core::symmetric_eigen(scatter);
  const double largest = *std::ranges::max_element(eigen.values);
  out.dimensions = static_cast<std::size_t>(
      std::ranges::count_if(eigen.values, [&](double value) { return value > flat * flat * largest; }));
  const auto least = static_cast<std::size_t>(std::ranges::min_element(eigen.values) - eigen.values.begin());
  for (std::size_t axis = 0; axis < Axes; ++axis) out.normal[axis] = eigen.vectors[least][axis];
  // Upwards; where it lies flat, to positive y or x.
  const auto up = std::find_if(out.normal.rbegin(), out.normal.rend(), [](double n) { return std::abs(n) > flat; });
  if (up != out.normal.rend() && *up < 0.0)
    for (double& component : out.normal) component = -component;
  return out;
}

}  // namespace

Extent extent_of(std::span<const Place> places, bool from_above) {
  return from_above ? extent<2>(places) : extent<3>(places);
}

}  // namespace ridgeloc::studies
