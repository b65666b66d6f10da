#pragma once

#include <functional>
#include <string>

namespace ridgeloc::app {

/// Reads a result, or the parts of one, in a child process, whose memory and time are limited in proportion to the
/// files, and drops what was read. The HDF5 library crashes on some damaged files, and files can be made to ask for any
/// amount of memory: the child finds out. Throws core::InputError if it does not survive, core::IoError if this process
/// has too little memory or if reading takes `patience` times as long as the processor time that it may take; errors
/// that `read` throws are left to be found again. Precondition: no other thread is reading or writing results.
void probe(const std::string& result, const std::function<void()>& read, double patience = 12.0);

/// What `read` returns, after a child process has survived the same.
template <typename Read>
auto read_probed(const std::string& result, Read&& read) {
  probe(result, [&read] { read(); });
  return read();
}

}  // namespace ridgeloc::app
