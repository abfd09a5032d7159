// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace spindrift::gl
{

/// Keeps what the driver of the current context reports as errors, undefined behaviour or use of what is not
/// portable; notes about speed are ignored. Needs GLEW loaded.
void start_debug_log();

/// Everything kept so far, one message a line.
std::string debug_log();

}  // namespace spindrift::gl
