#pragma once

namespace ridgeloc::bench {

/// Prints, per peer and number of points, how its answers compare with our least-squares minima, and returns whether
/// every peer solves the problem that we solve: in the trials where both converge in one basin, nearly all of its
/// estimates lie as near to the minimum as its stop rule asks.
bool check_peers();

}  // namespace ridgeloc::bench
