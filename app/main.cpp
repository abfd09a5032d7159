// SPDX-License-Identifier: MIT
#include <cstdio>
#include <exception>

#include <fmt/format.h>

#include "app/command_line.h"
#include "app/exit_codes.h"
#include "core/error.h"

namespace
{

/// An answer that did not reach its reader is a failure, whatever was computed.
int flushed(int code)
{
    if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0) return code;
    std::fputs("spindrift: standard output cannot be written (is the disk full?)\n", stderr);
    return code == spindrift::app::kOk ? spindrift::app::kBadInput : code;
}

}  // namespace

int main(int argc, char** argv)
{
    try
    {
        return flushed(spindrift::app::run_command_line(argc, argv));
    }
    catch (const spindrift::Error& e)
    {
        fmt::print(stderr, "spindrift: {}\n", e.what());
        return spindrift::app::kBadInput;
    }
    catch (const std::exception& e)
    {
        fmt::print(stderr, "spindrift: internal error: {}\n", e.what());
        return spindrift::app::kInternalError;
    }
}
