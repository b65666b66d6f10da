#pragma once

#include <cstddef>
#include <string_view>

namespace ridgeloc::bench {

/// `count` passes of 4096 trials each, for a count of instructions (bench/instructions.py): "rrr" solves the problems
/// of 5 points, "block" computes blocks of bench/sweep.toml. With the kernels for AVX2, the widest that counters know.
/// Throws core::InputError for another name or a processor without AVX2.
void pass(std::string_view work, std::size_t count);

}  // namespace ridgeloc::bench
