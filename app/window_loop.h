// SPDX-License-Identifier: MIT
#pragma once

#include "app/run_loop.h"

namespace spindrift::app
{

/// Runs a scene in a window until it is closed, --frames are shown or a signal comes.
/// Throws Error that names --headless if there is no display.
void draw_in_window(RunState& run);

}  // namespace spindrift::app
