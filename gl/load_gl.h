// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "gl/context.h"

namespace spindrift::gl
{

/// Loads the functions of the current context, starts the debug log and tells what was found. Throws Error if
/// it is not OpenGL 4.5.
ContextInfo load_gl(const std::string& platform);

}  // namespace spindrift::gl
