#pragma once

#include <iosfwd>
#include <set>
#include <vector>

#include "studies/measured/epoch.hpp"
#include "studies/measured/epoch_solver.hpp"
#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// Collects what a study with one's own errors and one's own places needs, from the answers of one method.
class GivenStudy {
 public:
  /// Takes the residuals of a converged answer with more readings n than unknowns p, times sqrt(n / (n - p)), as a fit
  /// makes residuals smaller than the errors by that factor on the average; and its position, if there is room for it.
  void add(const Epoch& epoch, const Fix& fix, bool knows_height);

  std::size_t errors() const { return errors_m_.size(); }
  std::size_t places() const { return places_.size(); }

  /// The errors, at most as many as a study takes, evenly from all that there were, as a CSV file that `noise_samples =
  /// { file = ..., column = "error_m" }` reads.
  void write_noise(std::ostream& out) const;

  /// The study of which the methods are, with these objects, these true positions of the camera and the root mean
  /// square of these errors as the noise, coordinates from an origin near them, which a comment names. Throws
  /// core::InputError where there is nothing to make a scene of, or more objects than a study takes.
  void write_scene(std::ostream& out, Study study) const;

 private:
  void add_error(double error_m);

  std::vector<double> errors_m_;  ///< every `stride_`-th
  std::size_t stride_ = 1;
  std::size_t offered_ = 0;
  std::set<Place> objects_;
  std::vector<Place> places_;
};

}  // namespace ridgeloc::studies
