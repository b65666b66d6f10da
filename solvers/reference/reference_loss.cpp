#include "solvers/reference/reference_loss.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/elementary.hpp"

namespace ridgeloc::solvers {

namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Of q = u / c: F = integral of w(p) 2 p dp up to q, w itself, and w'(q) / q.
struct Shape {
  double integral;
  double weight;
  double slope;
};

Shape squares(double q) {
  return {q * q, 1.0, 0.0};
}

Shape huber(double q) {
  if (q <= 1.0) return squares(q);
  return {2.0 * q - 1.0, 1.0 / q, -1.0 / (q * q * q)};
}

Shape tukey(double q) {
  if (q > 1.0) return {1.0 / 3.0, 0.0, 0.0};
  const double rest = 1.0 - q * q;
  return {(1.0 - rest * rest * rest) / 3.0, rest * rest, -4.0 * rest};
}

Shape cauchy(double q) {
  const double inverse = 1.0 / (1.0 + q * q);
  // Our own logarithm: that of the C library may differ from processor to processor.
  return {core::log(1.0 + q * q), inverse, -2.0 * inverse * inverse};
}

Shape geman_mcclure(double q) {
  const double inverse = 1.0 / (1.0 + q * q);
  return {q * q * inverse, inverse * inverse, -4.0 * inverse * inverse * inverse};
}

Shape igg3(double q) {
  if (q <= 1.0) return squares(q);
  const double rest = std::max(2.0 - q, 0.0);
  const double slope = q < 2.0 ? -(4.0 - q * q) / (q * q * q) : 0.0;
  return {1.0 + 2.0 / 3.0 * (1.0 - rest * rest * rest), rest * rest / q, slope};
}

Shape shape_at(LossShape shape, double q) {
  switch (shape) {
    case LossShape::Squares:
      return squares(q);
    case LossShape::Huber:
      return huber(q);
    case LossShape::Tukey:
      return tukey(q);
    case LossShape::Cauchy:
      return cauchy(q);
    case LossShape::GemanMcClure:
      return geman_mcclure(q);
    case LossShape::Igg3:
      return igg3(q);
  }
  return squares(q);
}

/// The q at which the weight has fallen to `floor` > 0; weights do not rise.
double fallen_to(LossShape shape, double floor) {
  switch (shape) {
    case LossShape::Squares:
      return infinite;
    case LossShape::Huber:
      return 1.0 / floor;
    case LossShape::Tukey:
      return std::sqrt(1.0 - std::sqrt(floor));
    case LossShape::Cauchy:
      return std::sqrt(1.0 / floor - 1.0);
    case LossShape::GemanMcClure:
      return std::sqrt(1.0 / std::sqrt(floor) - 1.0);
    case LossShape::Igg3: {
      // (2 - q)^2 = floor q
      const double half = 2.0 + 0.5 * floor;
      return half - std::sqrt(half * half - 4.0);
    }
  }
  return infinite;
}

}  // namespace

std::optional<LossShape> find_loss_shape(std::string_view weight_name) {
  constexpr std::pair<std::string_view, LossShape> shapes[] = {{"huber", LossShape::Huber},
                                                               {"tukey", LossShape::Tukey},
                                                               {"cauchy", LossShape::Cauchy},
                                                               {"geman_mcclure", LossShape::GemanMcClure},
                                                               {"igg3", LossShape::Igg3}};
  for (const auto& [name, shape] : shapes) {
    if (name == weight_name) return shape;
  }
  return std::nullopt;
}

double standard_tuning(LossShape shape) {
  switch (shape) {
    case LossShape::Huber:
      return 1.345;
    case LossShape::Tukey:
      return 4.685;
    case LossShape::Cauchy:
      return 2.385;
    case LossShape::Igg3:
      return 1.5;
    case LossShape::Squares:
    case LossShape::GemanMcClure:
      break;
  }
  return 1.0;
}

std::array<double, 3> RobustLoss::operator()(double squared_residual) const {
  const double unit = scale_m * tuning;  // residual at which q is 1
  const double q = std::sqrt(squared_residual) / unit;
  Shape at = shape_at(shape, q);
  if (smallest_weight > 0.0) {
    if (const double edge = fallen_to(shape, smallest_weight); q > edge) {
      at = {shape_at(shape, edge).integral + smallest_weight * (q - edge) * (q + edge), smallest_weight, 0.0};
    }
  }
  const double kept = 1.0 - lift;
  return {lift * squared_residual + kept * unit * unit * at.integral, lift + kept * at.weight,
          kept * at.slope / (2.0 * unit * unit)};
}

}  // namespace ridgeloc::solvers
