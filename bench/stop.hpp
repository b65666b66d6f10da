#pragma once

namespace ridgeloc::bench {

/// The stop rule that "matched" rows share: a step shorter than this is the last one, and there are at most so many.
inline constexpr double step_tolerance_m = 0.05;
inline constexpr int max_steps = 30;

}  // namespace ridgeloc::bench
