// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>

namespace spindrift
{

/// Bad input, or a machine that cannot do what was asked. what() is one line that a person can act on:
/// "scenes/town.toml:41: wind.speed_m_s = -3 is negative (why it matters); use 0 or more".
/// The command prints it and ends with exit code 2. It is the only way in which Spindrift reports bad input.
class Error : public std::runtime_error
{
  public:
    explicit Error(const std::string& message) : std::runtime_error(message) {}
};

}  // namespace spindrift
