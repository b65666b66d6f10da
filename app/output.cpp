#include "app/output.hpp"

#include <fstream>
#include <iostream>

#include "core/error.hpp"
#include "results/file_system.hpp"

namespace ridgeloc::app {

void write_output(const std::string& path, const std::function<void(std::ostream&)>& write) {
  if (path.empty()) {
    write(std::cout);
    std::cout.flush();
    if (!std::cout) throw core::IoError("standard output cannot be written");
    return;
  }
  results::require_writable(path);
  results::TemporaryFile file(path);
  std::ofstream out(file.path(), std::ios::binary);
  write(out);
  out.close();
  if (!out) throw core::IoError(path + ": writing failed; is the disk full?");
  file.publish();
}

}  // namespace ridgeloc::app
