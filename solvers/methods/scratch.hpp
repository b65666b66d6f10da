#pragma once

#include <cstddef>

namespace ridgeloc::solvers {

/// Room for `size` numbers that belongs to the calling thread until its next call. Allocates only when it grows.
double* scratch_of_thread(std::size_t size);

}  // namespace ridgeloc::solvers
