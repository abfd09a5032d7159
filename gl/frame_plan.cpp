// SPDX-License-Identifier: MIT
#include "gl/frame_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "gl/active_lights.h"

namespace spindrift::gl
{

namespace
{

using scene::Blending;
using scene::FlakePath;

/// Everything that the decisions look at, gathered once.
struct Facts
{
    const scene::Scene& scene;
    const FrameStats& last;
    ActiveLights lights;
    bool has_flakes;
    bool has_solids;
    bool blended;  // alpha is used
    GlKind gl;

    Facts(const scene::Scene& s, const View& view, const FrameStats& stats, double time_s,
          std::span<const scene::Light> model_lights, GlKind kind)
        : scene(s),
          last(stats),
          lights(active_lights(s, model_lights, view, time_s)),
          has_flakes(stats.counts.alive > 0),
          has_solids(s.ground.kind != scene::GroundKind::none || !s.boxes.empty() || !s.models.empty()),
          blended(s.render.blending != Blending::opaque),
          gl(kind)
    {
    }

    bool in_tiles() const
    {
        const FlakePath path = scene.render.flake_path;
        return blended && gl != GlKind::out_of_reach &&
               (path == FlakePath::tiles || (path == FlakePath::automatic && gl == GlKind::software));
    }
};

PlannedPass runs(std::string name, std::string reason, std::string reads, std::string writes)
{
    return {std::move(name), true, std::move(reason), std::move(reads), std::move(writes)};
}

PlannedPass left_out(std::string name, std::string reason)
{
    return {std::move(name), false, std::move(reason), "", ""};
}

PlannedPass plan_cull(const Facts& facts)
{
    if (!facts.has_flakes) return left_out("cull", "no flakes are alive");
    if (!facts.last.flakes_moved && !facts.last.camera_moved)
        return left_out("cull", "flakes and camera are at rest: the draw list of the last frame holds");
    return runs(
        "cull",
        fmt::format("{} flakes are alive; only visible ones are sorted and drawn", facts.last.counts.alive),
        "flake positions, view", "draw list");
}

PlannedPass plan_sort(const Facts& facts)
{
    if (!facts.has_flakes) return left_out("sort", "no flakes are alive");
    if (facts.scene.render.blending == Blending::additive)
        return left_out("sort", "additive blending gives the same sum in any order");
    if (facts.scene.render.blending == Blending::opaque)
        return left_out("sort", "opaque points are ordered by the depth buffer");
    if (facts.scene.render.sort == "none")
        return left_out("sort", "the scene asks for none: over-blending out of order is wrong");
    if (!facts.last.flakes_moved && !facts.last.camera_moved)
        return left_out("sort", "flakes and camera are at rest: the order of the last frame holds");
    return runs("sort",
                fmt::format("over-blending needs far to near ({}, {} bits)", facts.scene.render.sort,
                            facts.scene.render.depth_bits),
                "draw list", "draw list");
}

std::string dark_reason(const ActiveLights& lights)
{
    std::string reason;
    const auto add = [&](int count, const char* what)
    {
        if (count == 0) return;
        if (!reason.empty()) reason += ", ";
        reason += fmt::format("{} {}", count, what);
    };
    add(lights.absent, "absent or off");
    add(lights.dark_now, "in the dark part of the flash");
    add(lights.out_of_range, "out of range of all that is seen");
    return reason;
}

PlannedPass plan_lights(const Facts& facts)
{
    const std::string dark = dark_reason(facts.lights);
    if (facts.lights.lamps.empty())
        return left_out("lights", dark.empty() ? "the scene has no lights: ambient only"
                                               : fmt::format("no light counts now ({}): ambient only", dark));
    return runs(
        "lights",
        fmt::format("{} light{} on{}", facts.lights.lamps.size(), facts.lights.lamps.size() == 1 ? "" : "s",
                    dark.empty() ? "" : fmt::format("; left out: {}", dark)),
        "light table, display time", "lights");
}

PlannedPass plan_scene(const Facts& facts)
{
    if (!facts.has_solids) return left_out("scene", "no ground, box or model");
    return runs("scene", "solid things hide flakes and are lit", "meshes, lights", "picture, depth");
}

PlannedPass plan_fade(const Facts& facts)
{
    if (!facts.has_flakes) return left_out("fade", "no flakes are alive");
    if (!facts.blended) return left_out("fade", "opaque points do not fade where they cut into the scene");
    if (!facts.has_solids) return left_out("fade", "nothing solid to cut into");
    if (facts.in_tiles()) return left_out("fade", "the tiles look at the depth of each pixel");
    return runs("fade", "flakes fade where they cut into the scene; hidden ones are dropped early", "depth",
                "copy of depth, depth tiles");
}

std::string_view blending_name(Blending blending)
{
    switch (blending)
    {
        case Blending::over:
            return "over";
        case Blending::additive:
            return "additive";
        case Blending::opaque:
            return "opaque";
    }
    return "";
}

std::string flakes_reason(const Facts& facts)
{
    const std::size_t lamps = facts.lights.lamps.size();
    return fmt::format("{} blending, {} a flake", blending_name(facts.scene.render.blending),
                       lamps == 0 ? std::string("no scattering loop")
                                  : fmt::format("{} phase function{}", lamps, lamps == 1 ? "" : "s"));
}

PlannedPass plan_flakes(const Facts& facts)
{
    if (!facts.has_flakes) return left_out("flakes", "no flakes are alive");
    if (facts.in_tiles()) return left_out("flakes", "drawn in tiles instead of as points");
    return runs("flakes", flakes_reason(facts),
                facts.blended ? "flakes, draw list, lights, depth, copy of depth, depth tiles"
                              : "flakes, draw list, lights, depth",
                facts.blended ? "picture" : "picture, depth");
}

PlannedPass plan_tiles(const Facts& facts)
{
    if (!facts.has_flakes) return left_out("tiles", "no flakes are alive");
    if (!facts.blended) return left_out("tiles", "opaque points go by the depth buffer");
    const bool asked = facts.scene.render.flake_path != FlakePath::automatic;
    if (facts.gl == GlKind::out_of_reach)
        return left_out("tiles", "the processor cannot read the flakes where CUDA writes them");
    if (!facts.in_tiles())
        return left_out("tiles", asked ? "the scene asks for raster"
                                       : "only software GL needs them: a GPU sets up points by itself");
    return runs(
        "tiles",
        fmt::format("{}; {}", flakes_reason(facts),
                    asked ? "the scene asks for tiles" : "software GL sets up points on one thread only"),
        "flakes, draw list, lights, depth, picture", "picture");
}

PlannedPass plan_tone(const Facts& facts)
{
    const bool in_tiles = facts.has_flakes && facts.in_tiles();
    return runs("tone",
                fmt::format("exposure {:g}, clamp, sRGB{}", facts.scene.render.exposure,
                            in_tiles ? ", in the tiles: nothing comes between" : ""),
                "picture", "display");
}

}  // namespace

bool FramePlan::runs(std::string_view name) const
{
    return std::any_of(passes.begin(), passes.end(),
                       [&](const PlannedPass& pass) { return pass.name == name && pass.runs; });
}

FramePlan plan_frame(const scene::Scene& scene, const View& view, const FrameStats& last, double time_s,
                     std::span<const scene::Light> model_lights, GlKind gl)
{
    const Facts facts(scene, view, last, time_s, model_lights, gl);
    FramePlan plan;
    plan.passes.push_back(plan_cull(facts));
    plan.passes.push_back(plan_sort(facts));
    plan.passes.push_back(plan_lights(facts));
    plan.passes.push_back(plan_scene(facts));
    plan.passes.push_back(runs("sky", "fills what the scene leaves free", "depth", "picture"));
    plan.passes.push_back(plan_fade(facts));
    plan.passes.push_back(plan_flakes(facts));
    plan.passes.push_back(plan_tiles(facts));
    plan.passes.push_back(plan_tone(facts));
    return plan;
}

std::string to_text(const FramePlan& plan)
{
    std::size_t widest = 0;
    for (const PlannedPass& pass : plan.passes) widest = std::max(widest, pass.name.size());
    std::string text;
    for (const PlannedPass& pass : plan.passes)
    {
        text += fmt::format("{} {:<{}}  {}\n", pass.runs ? "->" : " -", pass.name, widest, pass.reason);
        if (!pass.runs) continue;
        text += fmt::format("   {:<{}}  reads {}; writes {}\n", "", widest, pass.reads, pass.writes);
    }
    return text;
}

}  // namespace spindrift::gl
