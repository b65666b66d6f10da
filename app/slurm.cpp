#include "app/slurm.hpp"

#include <fmt/format.h>

#include <cmath>

#include "results/util/shell.hpp"

namespace ridgeloc::app {

namespace {

using results::shell_word;

/// Slurm kills a task at its limit: room for a machine of half the speed, and for one that is slow to begin.
constexpr double slowdown = 2.0;
constexpr double start_s = 600.0;
/// What a task needs to end its blocks and to write its part; Slurm may signal up to a minute early.
constexpr int notice_s = 120;

/// D-HH:MM:SS, in whole minutes.
std::string time_limit(double seconds) {
  const auto minutes = static_cast<std::uint64_t>(std::ceil((slowdown * seconds + start_s) / 60.0));
  return fmt::format("{}-{:02}:{:02}:00", minutes / 1440, minutes % 1440 / 60, minutes % 60);
}

std::string run_command(const SlurmJob& job) {
  std::string command = "ridgeloc run " + shell_word(job.study);
  for (const std::string& item : job.overrides) command += " --set " + shell_word(item);
  return fmt::format("{} --isa {} --threads {} --shard \"$SLURM_ARRAY_TASK_ID/{}\"", command, job.isa, job.threads,
                     job.shares);
}

}  // namespace

std::string merge_command(const SlurmJob& job) {
  return fmt::format("ridgeloc merge {}*-of-{}.h5 -o {}", shell_word(job.name + ".shard-"), job.shares,
                     shell_word(job.name + ".h5"));
}

std::string slurm_script(const SlurmJob& job) {
  // Without "B:" Slurm signals what srun has started, and not the script, whose process ridgeloc becomes.
  return fmt::format(
      "#!/bin/sh\n"
      "#SBATCH --array=1-{}\n"
      "#SBATCH --cpus-per-task={}\n"
      "#SBATCH --time={}\n"
      "#SBATCH --signal=B:USR1@{}\n"
      "# In this folder, first:\n"
      "#   sbatch {}\n"
      "# A share that was stopped goes on when the script is submitted again. When all are there:\n"
      "#   {}\n"
      "exec {}\n",
      job.shares, job.threads, time_limit(job.seconds), notice_s, shell_word(job.script), merge_command(job),
      run_command(job));
}

}  // namespace ridgeloc::app
