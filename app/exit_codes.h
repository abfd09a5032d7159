// SPDX-License-Identifier: MIT
#pragma once

namespace spindrift::app
{

/// What the command answers to the shell. README and --help list them.
enum ExitCode : int
{
    kOk = 0,
    kInternalError = 1,  ///< a defect of the program
    kCheckFailed = 1,    ///< of `spindrift validate`: something measured is not what it should be
    kBadInput = 2,       ///< something that the user can put right; one line on stderr says what
    kInterrupted = 130,  ///< SIGINT or SIGTERM; every file is whole
};

}  // namespace spindrift::app
