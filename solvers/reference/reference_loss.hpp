#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace ridgeloc::solvers {

/// The function that a robust weight is the derivative of.
enum class LossShape { Squares, Huber, Tukey, Cauchy, GemanMcClure, Igg3 };

/// The shape that belongs to a weight of `weight_registry()`, if there is one.
std::optional<LossShape> find_loss_shape(std::string_view weight_name);

/// The tuning constant that a shape has by itself.
double standard_tuning(LossShape shape);

/// rho(s) of a squared residual s = e^2, made so that a term rho / 2 of an objective has the derivative w e de/dx,
/// where
///   w = f + lift (1 - f),   f = max(w_shape(|e| / scale), smallest_weight).
/// In closed form, rho(0) = 0. With u = |e| / scale, c the tuning constant and x = (u / c)^2, w_shape is
///   huber 1, beyond c: c / u;   tukey (1 - x)^2, beyond c: 0;   cauchy 1 / (1 + x);   geman_mcclure 1 / (1 + x)^2;
///   igg3 1, beyond c: (c / u) (2 - u / c)^2, beyond 2 c: 0;     squares 1.
struct RobustLoss {
  LossShape shape = LossShape::Squares;
  double tuning = 1.0;
  double scale_m = 1.0;
  double smallest_weight = 0.0;
  double lift = 0.0;

  /// rho, its first and its second derivative. Where the second jumps, that from below.
  std::array<double, 3> operator()(double squared_residual) const;

  bool operator==(const RobustLoss&) const = default;

  double weight(double residual) const { return (*this)(residual * residual)[1]; }
};

}  // namespace ridgeloc::solvers
