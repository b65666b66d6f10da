#pragma once

namespace ridgeloc::solvers {

/// Speed against the time that kernels take to compile.
enum class KernelSize {
  Small,     ///< one register for each value
  Wide,      ///< two
  Unrolled,  ///< two, and kernels of their own for the usual numbers of ranges
};

}  // namespace ridgeloc::solvers
