#pragma once

namespace ridgeloc::solvers {

/// Speed against the time that kernels take to compile.
enum class KernelSize {
  Small,     ///< one register for each value
  Wide,      ///< two
  Unrolled,  ///< two, and kernels of their own for the usual numbers of ranges
};

/// Whether the usual options and numbers of ranges have kernels of their own (RIDGELOC_SPECIALIZED_KERNELS of CMake).
/// The numbers are the same.
#ifdef RIDGELOC_SPECIALIZED_KERNELS
inline constexpr bool has_specialized_kernels = true;
#else
inline constexpr bool has_specialized_kernels = false;
#endif

}  // namespace ridgeloc::solvers
