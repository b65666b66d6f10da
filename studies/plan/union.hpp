#pragma once

#include <string>
#include <vector>

#include "studies/study/study.hpp"

namespace ridgeloc::studies {

/// In what two studies differ of that which changes every number: "seed is 1, not 2018", a text for each key. Results
/// of studies with such a difference cannot be combined.
std::vector<std::string> differences(const Study& found, const Study& wanted);

/// The study that has all cells, methods and trials of two: title, figures and the order of values and methods are
/// those of `study`; what only `other` has follows (or, where both list numbers in ascending order, lies between). The
/// larger number of trials counts, for every cell.
///
/// Precondition: no `differences`. Throws core::InputError where one name stands for methods with different settings,
/// or the axes are zipped in another way.
Study united(Study study, const Study& other);

}  // namespace ridgeloc::studies
