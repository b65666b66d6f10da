#include "solvers/methods/scratch.hpp"

#include <vector>

namespace ridgeloc::solvers {

double* scratch_of_thread(std::size_t size) {
  thread_local std::vector<double> room;
  if (room.size() < size) room.resize(size);
  return room.data();
}

}  // namespace ridgeloc::solvers
