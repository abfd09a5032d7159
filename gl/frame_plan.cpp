// SPDX-License-Identifier: MIT
#include "gl/frame_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/airlight.h"
#include "core/visibility.h"
#include "gl/active_lights.h"
#include "gl/bloom_shape.h"
#include "gl/cluster_lamps.h"
#include "gl/glow_grid_pass.h"
#include "gl/pass_cost.h"
#include "scene/air.h"

namespace spindrift::gl
{

namespace
{

using scene::Blending;

/// Air that lets more than this share through to the far plane is left out.
constexpr double kClearEnough = 0.995;
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
    double far_clear;  // least transmittance of the air up to the far plane

    Facts(const scene::Scene& s, const View& view, const FrameStats& stats, double time_s,
          std::span<const scene::Light> model_lights, GlKind kind)
        : scene(s),
          last(stats),
          lights(active_lights(s, model_lights, view, time_s)),
          has_flakes(stats.counts.alive > 0),
          has_solids(s.ground.kind != scene::GroundKind::none || !s.boxes.empty() || !s.models.empty()),
          blended(s.render.blending != Blending::opaque),
          gl(kind),
          far_clear(scene::far_transmittance(s, view))
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
    if (facts.scene.render.blending == Blending::weighted)
        return left_out("sort", "weighted blending shares out a pixel by depth, not by order");
    if (facts.scene.render.blending == Blending::stochastic)
        return left_out("sort", "each sample keeps the nearest flake, in whatever order they come");
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
    const std::size_t lamps = facts.lights.lamps.size(), ending = count_bounded(facts.lights.lamps);
    std::string reach;
    if (lamps > 1)
        reach = ending == lamps ? ", each where it reaches"
                                : fmt::format(", {} of them everywhere: no range", lamps - ending);
    return runs("lights",
                fmt::format("{} light{} on{}{}", lamps, lamps == 1 ? "" : "s", reach,
                            dark.empty() ? "" : fmt::format("; left out: {}", dark)),
                "light table, display time", "lights");
}

/// The lights that cast shadows by their maps, and how they are looked up.
LitBy lit_by(const Facts& facts, const ShadowCast& cast)
{
    LitBy lit;
    lit.lights = facts.lights.lamps.size();
    lit.maps = !cast.lamps.empty() && facts.has_solids;
    lit.snow = !cast.lamps.empty() && facts.scene.shadows.snow_slices > 0 && facts.has_flakes &&
               facts.scene.render.blending != Blending::additive;
    if (lit.maps || lit.snow) lit.shadows = cast.lamps.size();
    return lit;
}

PlannedPass plan_shadows(const Facts& facts, const LitBy& lit, const ShadowCast& cast)
{
    if (!facts.has_solids) return left_out("shadows", "no ground, box or model");
    if (!lit.maps) return left_out("shadows", "no light that shines casts shadows");
    if (cast == facts.last.shadows)
        return left_out("shadows", "lights and what stands before them are at rest: the maps of before hold");
    const int px = facts.scene.shadows.map_px;
    return runs("shadows",
                fmt::format("{} map{} of {} x {} px", lit.shadows, lit.shadows == 1 ? "" : "s", px, px),
                "meshes, lights", "shadow maps");
}

PlannedPass plan_snow_shade(const Facts& facts, const LitBy& lit, const ShadowCast& cast)
{
    if (cast.lamps.empty()) return left_out("snow shade", "no light that shines casts shadows");
    if (facts.scene.shadows.snow_slices == 0)
        return left_out("snow shade", "the scene asks for no slices: flakes do not dim light");
    if (!facts.has_flakes) return left_out("snow shade", "no flakes are alive");
    if (!lit.snow) return left_out("snow shade", "additive flakes hide nothing");
    if (facts.last.snow_shaded && !facts.last.flakes_moved && cast == facts.last.shadows)
        return left_out("snow shade", "flakes and lights are at rest: the slices of before hold");
    const scene::ShadowSettings& shadows = facts.scene.shadows;
    return runs(
        "snow shade",
        fmt::format("flakes dim {} light{}: {} slices of {} x {} px each", lit.shadows,
                    lit.shadows == 1 ? "" : "s", shadows.snow_slices, shadows.snow_px, shadows.snow_px),
        "flakes, lights", "snow slices");
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

PlannedPass plan_fog(const Facts& facts)
{
    const scene::AirSettings& air = facts.scene.air;
    if (facts.far_clear == 1) return left_out("fog", "the air is clear but for the flakes that are drawn");
    if (facts.far_clear > kClearEnough)
        return left_out("fog", fmt::format("the air lets {:.2f} % through up to the far plane (above {:g} %)",
                                           100 * facts.far_clear, 100 * kClearEnough));
    const double extinction = scene::uniform_extinction(facts.scene);
    std::string reason = facts.scene.air.law == scene::FogLaw::legacy
                             ? "the report's line, visibility - distance / 600 m"
                             : "takes over where flakes end or are too small to draw";
    if (extinction > 0)
        reason = fmt::format("extinction {:.3g} 1/m, visibility {:.3g} m ({}); {}", extinction,
                             visibility_of_extinction(extinction, air.contrast),
                             air.contrast == VisibilityContrast::five_percent ? "5 %" : "2 %", reason);
    if (std::isfinite(air.drift_visibility_m))
        reason += fmt::format("; drift of {:g} m visibility, {:g} m high", air.drift_visibility_m,
                              air.drift_height_m);
    return runs("fog", reason, "depth, lights", "picture, copy of depth");
}

PlannedPass plan_airlight(const Facts& facts)
{
    if (facts.far_clear > kClearEnough) return left_out("airlight", "no fog that could glow");
    if (!facts.scene.air.airlight || facts.scene.air.law == scene::FogLaw::legacy)
        return left_out("airlight", "the scene asks for none");
    const auto lamps =
        std::count_if(facts.lights.lamps.begin(), facts.lights.lamps.end(),
                      [](const Lamp<float>& lamp) { return lamp.kind != LampKind::directional; });
    if (lamps == 0)
        return left_out("airlight", "no point or spot lamp shines (the sun is in the fog's own light)");
    return runs("airlight",
                fmt::format("{} lamp{} glow{} in the fog, {} points each", lamps, lamps == 1 ? "" : "s",
                            lamps == 1 ? "s" : "", kAirlightPoints),
                "copy of depth, lights", "picture");
}

PlannedPass plan_glow_grids(const Facts& facts, const View& view, bool airlight, FramePlan& plan)
{
    constexpr const char* kName = "glow grids";
    if (!airlight) return left_out(kName, "no lamp glows");
    const std::size_t lamps = facts.lights.lamps.size();
    if (lamps <= LitProgram::kMostUnrolled)
        return left_out(kName, fmt::format("up to {} lights: each way integrates their glow itself",
                                           LitProgram::kMostUnrolled));
    const auto flakes =
        static_cast<double>(facts.last.drawn > 0 ? facts.last.drawn : facts.last.counts.alive);
    std::vector<std::int32_t> of_lamp = lamps_in_grids(facts.lights.lamps, plan.lit.shadows, view, flakes);
    const std::size_t grids = count_grids(of_lamp);
    if (grids == 0)
        return left_out(kName,
                        "each way integrates the glow itself: no point lamp with a range and without a "
                        "shadow is seen by ways enough");
    plan.glow_grids = std::move(of_lamp);
    plan.lit.glow_grids = true;
    return runs(kName,
                fmt::format("{} of {} lights: their glow is integrated on {} ways each, and looked up by all "
                            "others",
                            grids, lamps, GlowGrid::kRings * GlowGrid::kTurns),
                "lights", "glow grids");
}

std::string_view blending_name(Blending blending)
{
    switch (blending)
    {
        case Blending::over:
            return "over";
        case Blending::additive:
            return "additive";
        case Blending::weighted:
            return "weighted";
        case Blending::stochastic:
            return "stochastic";
        case Blending::opaque:
            return "opaque";
    }
    return "";
}

std::string flakes_reason(const Facts& facts)
{
    const std::size_t lamps = facts.lights.lamps.size();
    const double shutter_s = facts.scene.render.shutter_s;
    return fmt::format("{} blending, {} a flake{}", blending_name(facts.scene.render.blending),
                       lamps == 0 ? std::string("no scattering loop")
                                  : fmt::format("{} phase function{}", lamps, lamps == 1 ? "" : "s"),
                       shutter_s > 0 ? fmt::format(", streaks of {:g} s", shutter_s) : std::string());
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

PlannedPass plan_exposure(const Facts& facts)
{
    const scene::RenderSettings& render = facts.scene.render;
    if (!render.auto_exposure)
        return left_out("exposure", fmt::format("the scene sets it: {:g}", render.exposure));
    if (facts.last.exposed)
        return left_out("exposure", "that of this moment is known: both eyes of a pair have the same");
    return runs("exposure",
                fmt::format("log-average as {:g}, adapting in {:g} s", render.grey, render.adaptation_s),
                "picture, exposure", "exposure");
}

/// No channel of the picture is above this, exposed; infinite where that is not known. Without lamps a
/// surface or flake gives back at most the ambient light, and over-blending takes no more than the larger of
/// two.
double brightest_possible(const Facts& facts)
{
    const scene::Scene& scene = facts.scene;
    const bool sums_up = scene.render.blending == Blending::additive && facts.has_flakes;
    if (!facts.lights.lamps.empty() || sums_up || scene.render.auto_exposure)
        return std::numeric_limits<double>::infinity();
    double brightest = 0;
    for (const scene::Colour& c : {scene.sky.zenith, scene.sky.horizon, scene.sky.ambient})
        brightest = std::max({brightest, double{c.r}, double{c.g}, double{c.b}});
    const double surface = std::max({scene.sky.ambient.r, scene.sky.ambient.g, scene.sky.ambient.b});
    const double emission = facts.has_solids ? facts.last.brightest_emission : 0;
    constexpr double kRounding = 1.001;  // of half floats, which blending may add up
    return kRounding * scene.render.exposure * std::max(brightest, surface + emission);
}

std::string bloom_reason(const scene::BloomSettings& bloom, const BloomShape& shape)
{
    std::string how;
    switch (bloom.method)
    {
        case scene::BloomMethod::gaussian:
            how = fmt::format("exact Gaussian of {} taps an axis", 2 * shape.gauss_radius + 1);
            break;
        case scene::BloomMethod::reduced:
            how = fmt::format("Gaussian of {} taps an axis at 1/{} of the resolution",
                              2 * shape.gauss_radius + 1, shape.scale);
            break;
        case scene::BloomMethod::pyramid:
            how = fmt::format("13 taps down, tent up, {} levels", shape.levels);
            break;
        case scene::BloomMethod::dual:
            how = fmt::format("dual filter, {} levels", shape.levels);
            break;
        case scene::BloomMethod::legacy:
            how = fmt::format("box of {} taps an axis", 2 * shape.gauss_radius + 1);
            break;
    }
    return fmt::format(
        "spreads {:g} of what is above {:g}: {}, sigma {:.3g} px; nothing more than the first step "
        "where that finds nothing",
        bloom.weight, bloom.threshold, how, shape.sigma_px);
}

PlannedPass plan_bloom(const Facts& facts, const View& view)
{
    const scene::BloomSettings& bloom = facts.scene.bloom;
    if (bloom.weight == 0) return left_out("bloom", "its weight is 0");
    const double onset = bloom.threshold * (1 - bloom.knee);
    const double brightest = brightest_possible(facts);
    if (brightest <= onset)
        return left_out("bloom",
                        fmt::format("without lamps nothing can be above {:.3g}, and it sets in at {:.3g}",
                                    brightest, onset));
    return runs("bloom", bloom_reason(bloom, bloom_shape(bloom, view.height_px)), "picture, exposure",
                "spread light");
}

std::string_view curve_name(ToneCurve curve)
{
    switch (curve)
    {
        case ToneCurve::linear:
            return "clamp";
        case ToneCurve::reinhard:
            return "extended Reinhard";
        case ToneCurve::aces:
            return "ACES";
        case ToneCurve::agx:
            return "AgX";
        case ToneCurve::neutral:
            return "PBR Neutral";
        case ToneCurve::calibrated:
            return "calibrated";
        case ToneCurve::legacy:
            return "legacy gain";
    }
    return "";
}

/// Tiles can be developed as soon as they are blended where each channel of each pixel goes by itself.
bool tone_in_tiles(const Facts& facts, bool blooms)
{
    const ToneCurve curve = facts.scene.display.tone;
    const bool by_channel =
        curve == ToneCurve::linear || curve == ToneCurve::calibrated || curve == ToneCurve::legacy;
    return facts.has_flakes && facts.in_tiles() && by_channel && !blooms && !facts.scene.render.auto_exposure;
}

PlannedPass plan_tone(const Facts& facts, bool blooms, bool in_tiles)
{
    return runs("tone",
                fmt::format("{}, sRGB{}{}", curve_name(facts.scene.display.tone),
                            facts.scene.display.dither ? ", dither" : "",
                            in_tiles ? "; in the tiles: nothing comes between" : ""),
                blooms ? "picture, exposure, spread light" : "picture, exposure", "display");
}

}  // namespace

bool FramePlan::runs(std::string_view name) const
{
    return std::any_of(passes.begin(), passes.end(),
                       [&](const PlannedPass& pass) { return pass.name == name && pass.runs; });
}

bool Moving::operator==(const Moving& other) const
{
    const auto same = [](const Vec3f& a, const Vec3f& b) { return a.x == b.x && a.y == b.y && a.z == b.z; };
    const auto same_lamp = [&](const Lamp<float>& a, const Lamp<float>& b)
    {
        return a.kind == b.kind && same(a.position_m, b.position_m) && same(a.direction, b.direction) &&
               same(a.intensity, b.intensity);  // the rest of a lamp never changes
    };
    return std::equal(lamps.begin(), lamps.end(), other.lamps.begin(), other.lamps.end(), same_lamp) &&
           std::equal(vehicles.begin(), vehicles.end(), other.vehicles.begin(), other.vehicles.end(), same);
}

namespace
{

/// Flakes turn, and an exposure adapts, also where nothing moves.
bool stands_still(const Facts& facts, const Moving& moving)
{
    return !facts.has_flakes && !facts.last.camera_moved && !facts.scene.render.auto_exposure &&
           facts.last.shown && *facts.last.shown == moving;
}

void leave_all_out(FramePlan& plan)
{
    for (PlannedPass& pass : plan.passes)
        if (pass.runs)
            pass = left_out(pass.name, "no flakes are alive and nothing moves: the picture of before holds");
}

}  // namespace

FramePlan plan_frame(const scene::Scene& scene, const View& view, const FrameStats& last, double time_s,
                     std::span<const scene::Light> model_lights, GlKind gl)
{
    const Facts facts(scene, view, last, time_s, model_lights, gl);
    FramePlan plan;
    plan.passes.push_back(plan_cull(facts));
    plan.passes.push_back(plan_sort(facts));
    plan.passes.push_back(plan_lights(facts));
    plan.shadows = shadow_cast(scene, facts.lights.lamps, time_s);
    plan.lit = lit_by(facts, plan.shadows);
    plan.passes.push_back(plan_shadows(facts, plan.lit, plan.shadows));
    plan.passes.push_back(plan_snow_shade(facts, plan.lit, plan.shadows));
    plan.passes.push_back(plan_scene(facts));
    plan.passes.push_back(runs("sky", "fills what the scene leaves free", "depth", "picture"));
    PlannedPass airlight = plan_airlight(facts);
    plan.passes.push_back(plan_glow_grids(facts, view, airlight.runs, plan));
    if (plan.lit.glow_grids) airlight.reason += ", but those that have a grid";
    plan.passes.push_back(plan_fog(facts));
    plan.passes.push_back(airlight);
    plan.passes.push_back(plan_fade(facts));
    plan.passes.push_back(plan_flakes(facts));
    plan.passes.push_back(plan_tiles(facts));
    plan.passes.push_back(plan_exposure(facts));
    plan.passes.push_back(plan_bloom(facts, view));
    const bool blooms = plan.passes.back().runs;
    plan.tone_in_tiles = tone_in_tiles(facts, blooms);
    plan.passes.push_back(plan_tone(facts, blooms, plan.tone_in_tiles));
    plan.shown = {facts.lights.lamps, plan.shadows.vehicles};
    plan.still = stands_still(facts, plan.shown);
    if (plan.still) leave_all_out(plan);
    for (PlannedPass& pass : plan.passes)
        if (pass.runs) pass.cost = pass_cost(pass.name, scene, view, last);
    return plan;
}

namespace
{

std::string cost_text(const PassCost& cost)
{
    return fmt::format("about {:.3g} MB, {:.3g} million texels or flakes", cost.megabytes,
                       cost.million_elements);
}

}  // namespace

std::string to_text(const FramePlan& plan)
{
    std::size_t widest = 0;
    for (const PlannedPass& pass : plan.passes) widest = std::max(widest, pass.name.size());
    std::string text;
    PassCost total;
    for (const PlannedPass& pass : plan.passes)
    {
        text += fmt::format("{} {:<{}}  {}\n", pass.runs ? "->" : " -", pass.name, widest, pass.reason);
        if (!pass.runs) continue;
        text += fmt::format("   {:<{}}  reads {}; writes {}\n", "", widest, pass.reads, pass.writes);
        total.megabytes += pass.cost.megabytes;
        total.million_elements += pass.cost.million_elements;
        if (pass.cost.megabytes > 0) text += fmt::format("   {:<{}}  {}\n", "", widest, cost_text(pass.cost));
    }
    return text + fmt::format("In all {}; what flakes cover comes on top.\n", cost_text(total));
}

}  // namespace spindrift::gl
