// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spindrift::test
{

/// How to start the command under test.
struct Launch
{
    std::vector<std::string> arguments;
    std::string standard_output = {};               ///< a file instead of a pipe, such as /dev/full
    bool error_on_terminal = false;                 ///< stderr is a pseudo terminal
    std::vector<std::string> environment = {};      ///< NAME=value, added or replaced
    std::vector<std::string> unset = {};            ///< names taken out of the environment
    std::optional<std::size_t> largest_file_bytes;  ///< RLIMIT_FSIZE
    /// SIGINT is sent as soon as this file exists.
    std::filesystem::path interrupt_when_there_is = {};
};

struct Finished
{
    int exit_code = -1;  ///< 128 + signal if a signal killed it
    std::string output, error;
};

/// Runs `spindrift` with these arguments to its end.
Finished run_command(const Launch& launch);
Finished run_command(const std::vector<std::string>& arguments);

}  // namespace spindrift::test
