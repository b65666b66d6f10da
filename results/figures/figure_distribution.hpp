#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "results/figures/figure_data.hpp"
#include "results/figures/figure_names.hpp"
#include "results/statistics/histogram.hpp"

namespace ridgeloc::results {

/// How the values of one metric are distributed, as lines over a logarithmic axis of the metric itself.
///
/// The axis reaches from the 0.1 % to the 99.9 % quantile of all histograms, from tick to tick. Lines are read from the
/// bins of the histograms, between whose edges values are taken as spread evenly; of metrics with whole numbers, as
/// standing at these. An ECDF is the share of the values up to x, infinite ones in the population, with Wilson's 95 %
/// interval; a histogram the outline of the share of the values per octave, of whole numbers per number.
class FigureDistribution {
 public:
  using Kind = FigureNames::Kind;

  /// The histograms of all lines, which share the axis and the width of their bins. Precondition: kind is no curve.
  FigureDistribution(Kind kind, bool whole_numbers, const std::vector<const Histogram*>& histograms);

  /// At 1, 2 and 5 times the powers of ten; on a long axis only the powers have labels.
  std::vector<FigureTick> ticks() const;

  /// What the vertical axis shows.
  std::string y_label() const;

  std::vector<FigurePoint> points(const Histogram& histogram) const;

  /// Share of the values that lie outside of the axis, in [0, 1].
  double share_outside(const Histogram& histogram) const;

 private:
  std::vector<FigurePoint> cumulative(const Histogram& histogram) const;
  std::vector<FigurePoint> density(const Histogram& histogram) const;

  Kind kind_;
  bool whole_numbers_;
  double low_ = 0.0;  ///< ends of the axis
  double high_ = 0.0;
  std::uint32_t joined_ = 1;  ///< bins of the histogram that make one of a density
};

}  // namespace ridgeloc::results
