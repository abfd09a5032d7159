// SPDX-License-Identifier: MIT
#pragma once

namespace spindrift::app
{

/// Parses the arguments and runs the subcommand; returns the exit code. Help and the version go to stdout, a
/// wrong argument to stderr in one line. Throws what the subcommands throw.
int run_command_line(int argc, char** argv);

}  // namespace spindrift::app
