// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/flake.h"
#include "core/view.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// What the last frame told, for decisions of the next.
struct FrameStats
{
    FlakeCounts counts;
    bool flakes_moved = true;
    bool camera_moved = true;
    std::uint64_t drawn = 0;
};

struct PlannedPass
{
    std::string name;  ///< "sort", "sky", "scene", "flakes", "tone", ...
    bool runs = true;
    std::string reason;         ///< why it runs, or why it is left out
    std::string reads, writes;  ///< resources, for people
};

/// The passes of one frame in order, those left out included with their reason.
struct FramePlan
{
    std::vector<PlannedPass> passes;
    bool runs(std::string_view name) const;
};

/// Who runs GL, where that is known.
enum class GlKind
{
    unknown,
    hardware,
    software,
    out_of_reach,  ///< whoever it is: the flakes lie where the processor cannot read them
};

/// Pure: no GL, no clock. `time_s` is the display time of the frame (flashing lights); `model_lights` are
/// those that came with models (scene::Geometry), which shine like the scene's own; `gl` decides how flakes
/// are drawn where the scene leaves it open (unknown: as hardware).
FramePlan plan_frame(const scene::Scene& scene, const View& view, const FrameStats& last, double time_s,
                     std::span<const scene::Light> model_lights = {}, GlKind gl = GlKind::unknown);

/// As `spindrift explain` prints it.
std::string to_text(const FramePlan& plan);

}  // namespace spindrift::gl
