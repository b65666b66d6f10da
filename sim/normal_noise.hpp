#pragma once

#include <cstdint>

#include "core/problem.hpp"
#include "core/stream.hpp"

namespace ridgeloc::sim {

/// Independent standard normal errors. Points 2i and 2i + 1 share random block i.
void draw_normal_noise(const core::Stream& noise, std::uint64_t first_trial, core::ProblemBatch& problems);

}  // namespace ridgeloc::sim
