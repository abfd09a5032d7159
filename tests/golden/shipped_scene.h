// SPDX-License-Identifier: MIT
#pragma once

#include <ostream>
#include <string>

#include "gl/flake_buffers.h"
#include "image/image.h"
#include "scene/make_world.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::golden
{

/// How a scene of scenes/ is shown in a test: the same on every machine.
struct Showing
{
    std::string name;
    std::uint64_t particles = 4000;
    int width_px = 320, height_px = 180;
    double time_s = 1;
    /// Share of the pixels that may be off by more than 1e-2.
    double most_share_off = 5e-4;
    /// Relative L2 of the others.
    double most_rest = 1e-3;
    scene::FlakePath path = scene::FlakePath::raster;
};

inline void PrintTo(const Showing& showing, std::ostream* out)
{
    *out << showing.name << (showing.path == scene::FlakePath::tiles ? " in tiles" : "");
}

struct Shown
{
    image::Image linear;
    image::Image8 display;
    image::Image reference;   ///< the same frame by the reference renderer
    image::Image8 developed;  ///< what the reference makes of its own light
    std::uint64_t drawn = 0;
    std::string errors;  ///< what the driver complained of
};

/// Simulates up to the time on the CPU backend and draws one frame both ways. Needs a current context.
Shown show(const Showing& showing);

}  // namespace spindrift::golden
