#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ridgeloc::app {

/// A study to be computed in shares by a job array of Slurm, one task a share.
struct SlurmJob {
  std::string study;                   ///< as the command line names it
  std::string name;                    ///< of its results
  std::vector<std::string> overrides;  ///< KEY=VALUE
  std::string isa;                     ///< the same for all shares, as merging them asks for
  int threads = 1;                     ///< of each task
  std::uint64_t shares = 2;
  double seconds = 0.0;  ///< that a task is expected to take
  std::string script;    ///< file name of the script
};

/// The job script, with the commands to submit it and to merge the shares in its heading.
std::string slurm_script(const SlurmJob& job);

/// The command that puts the shares together.
std::string merge_command(const SlurmJob& job);

}  // namespace ridgeloc::app
