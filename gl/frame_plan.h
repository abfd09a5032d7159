// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/flake.h"
#include "core/view.h"
#include "gl/lamp_lens.h"
#include "gl/lit_program.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// What may change in a picture without flakes whose camera is at rest.
struct Moving
{
    std::vector<Lamp<float>> lamps;
    std::vector<Vec3f> vehicles;  ///< that carry models
    bool operator==(const Moving& other) const;
};

/// What the last frame told, for decisions of the next.
struct FrameStats
{
    FlakeCounts counts;
    bool flakes_moved = true;
    bool camera_moved = true;
    std::uint64_t drawn = 0;
    bool exposed = false;  ///< the exposure of this display time is known: the other eye of a pair was drawn
    /// Largest channel of what any surface emits; infinite where nobody looked.
    double brightest_emission = std::numeric_limits<double>::infinity();
    /// By what the last picture of this size was lit and where its vehicles stood; nothing if there is none.
    std::optional<Moving> shown;
    ShadowCast shadows;        ///< for which the maps of the last frame were drawn
    bool snow_shaded = false;  ///< the snow's slices of the last frame were drawn, too
};

/// An estimate that holds on any machine: what a pass touches. Overdraw is not foreseen.
struct PassCost
{
    double megabytes = 0;         ///< read and written
    double million_elements = 0;  ///< texels, flakes or vertices looked at
};

struct PlannedPass
{
    std::string name;  ///< "sort", "sky", "scene", "flakes", "tone", ...
    bool runs = true;
    std::string reason;         ///< why it runs, or why it is left out
    std::string reads, writes;  ///< resources, for people
    PassCost cost{};            ///< nothing for a pass that is left out
};

/// The passes of one frame in order, those left out included with their reason.
struct FramePlan
{
    std::vector<PlannedPass> passes;
    bool tone_in_tiles = false;  ///< the tiles are developed where they are blended, not by a pass of its own
    LitBy lit;                   ///< by what the lit passes are lit, maps that hold from before included
    ShadowCast shadows;          ///< what the maps depend on
    std::vector<std::int32_t> glow_grids;  ///< by lamp the number of its grid or -1; empty: no grids
    Moving shown;
    bool still = false;  ///< nothing runs: the picture of before holds
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
