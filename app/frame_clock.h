// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>

namespace spindrift::app
{

/// When frames are shown and how many fixed steps lie before them. Both are computed from the frame's number
/// and not by adding up, so that a run of any length keeps time and frame rate never changes the physics.
struct FrameClock
{
    double start_s;       ///< simulated time of frame 0 (warm-up, or where a snapshot goes on)
    double frames_per_s;  ///< > 0
    double step_s;        ///< > 0

    double time_s(std::uint64_t frame) const { return start_s + static_cast<double>(frame) / frames_per_s; }

    /// Steps that are complete at the frame's time. The margin forgives rounding of k/fps against n*step
    /// (1e-6 of a step).
    std::uint64_t steps_before(std::uint64_t frame) const
    {
        return static_cast<std::uint64_t>(std::floor(time_s(frame) / step_s + 1e-6));
    }
};

}  // namespace spindrift::app
