#pragma once

namespace ridgeloc::app {

/// Parses the command line, runs the verb and turns errors into one line on standard error and an exit code.
int run_command_line(int argc, char** argv);

}  // namespace ridgeloc::app
