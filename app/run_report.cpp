// SPDX-License-Identifier: MIT
#include "app/run_report.h"

#include <span>

#include <fmt/format.h>
#include <sys/resource.h>
#include <nlohmann/json.hpp>

#include "app/build_info.h"
#include "core/advect_job.h"
#include "core/flake.h"
#include "core/gradient_reach.h"
#include "image/whole_file.h"

namespace spindrift::app
{

namespace
{

using Json = nlohmann::ordered_json;

std::uint64_t peak_resident_bytes()
{
    rusage usage = {};
    getrusage(RUSAGE_SELF, &usage);
    return static_cast<std::uint64_t>(usage.ru_maxrss) * 1024;
}

Json build_json()
{
    return {
        {"version", kVersion}, {"build", kBuildType}, {"compiler", kCompiler}, {"sanitizers", kSanitizers}};
}

Json machine_json(const RunReport& report)
{
    Json backend = {
        {"name", report.choice.name}, {"why", report.choice.reason}, {"description", report.backend}};
    if (report.choice.name == "cpu")
    {
        backend["simd"] = report.simd;
        backend["threads"] = report.threads;
    }
    Json machine = {{"backend", backend},
                    {"flake_memory", report.way.memory},
                    {"interop", {{"shared", report.way.shared}, {"why", report.way.because}}}};
    if (report.gl)
        machine["gl"] = {{"platform", report.gl->platform},
                         {"renderer", report.gl->renderer},
                         {"vendor", report.gl->vendor},
                         {"version", report.gl->version},
                         {"software", report.gl->software}};
    else
        machine["gl"] = {{"skipped", report.no_gl_because}};
    return machine;
}

Json counts_json(const FlakeCounts& c)
{
    return {{"emitted", c.emitted},
            {"alive", c.alive},
            {"left", c.left},
            {"landed", c.landed},
            {"vanished", c.vanished},
            {"withheld", c.withheld},
            {"balance",
             {{"rule", "emitted = alive + left + landed + vanished"},
              {"difference", imbalance(c)},
              {"holds", imbalance(c) == 0}}}};
}

/// Of the living flakes, in the scene's frame; null where there are none.
Json bounds_json(const FlakeExtent& extent, const scene::Scene& scene)
{
    if (!(extent.lower.x <= extent.upper.x)) return nullptr;
    const auto corner = [&](const Vec3f& v)
    {
        const Vec3d& origin = scene.domain.min_m;
        return Json{origin.x + static_cast<double>(v.x), origin.y + static_cast<double>(v.y),
                    origin.z + static_cast<double>(v.z)};
    };
    return {{"min_m", corner(extent.lower)}, {"max_m", corner(extent.upper)}};
}

Json stages_json(const std::vector<StageSummary>& stages)
{
    Json result = Json::object();
    for (const StageSummary& s : stages)
        result[s.name] = {
            {"median", s.median_ms}, {"p95", s.p95_ms}, {"total", s.total_ms}, {"samples", s.samples}};
    return result;
}

Json passes_json(const std::vector<PassHistory>& passes)
{
    Json result = Json::array();
    for (const PassHistory& p : passes)
        result.push_back({{"pass", p.name},
                          {"frames_run", p.ran},
                          {"frames_skipped", p.skipped},
                          {"run_because", p.ran_because},
                          {"skipped_because", p.skipped_because}});
    return result;
}

Json skips_json(const RunReport& report)
{
    Json result = Json::array();
    for (const Skip& skip : report.skips) result.push_back({{"what", skip.what}, {"why", skip.why}});
    for (const PassHistory& pass : report.passes)
        for (const std::string& why : pass.skipped_because)
            result.push_back({{"what", "pass " + pass.name}, {"why", why}});
    return result;
}

Json memory_json(const RunReport& report, const World& world)
{
    const double capacity = static_cast<double>(world.capacity);
    return {{"capacity", world.capacity},
            {"bytes_per_particle",
             {{"state", kStateBytesPerFlake},
              {"draw_list", kDrawListBytesPerFlake},
              {"all_buffers", capacity > 0 ? static_cast<double>(report.buffer_bytes) / capacity : 0.0}}},
            {"flake_buffers_bytes", report.buffer_bytes},
            {"voxels",
             {{"cells", {world.voxels.nx, world.voxels.ny, world.voxels.nz}},
              {"bytes", world.voxels.clearance.size() + world.voxels.surface.size()}}},
            {"wind",
             {{"cells", {world.wind.nx, world.wind.ny, world.wind.nz}},
              {"bytes", world.wind.cells.size() * sizeof(WindCell)}}},
            {"peak_resident_bytes", peak_resident_bytes()}};
}

Json drawn_json(const DrawnFlakes& flakes)
{
    return {{"sort", flakes.sort.strategy},
            {"depth_bits", flakes.sort.depth_bits},
            {"passes_per_frame", flakes.sort.passes_per_frame},
            {"drawn_median", quantile(flakes.drawn, 0.5)},
            {"culled_median", quantile(flakes.culled, 0.5)}};
}

}  // namespace

std::int64_t imbalance(const FlakeCounts& c)
{
    return static_cast<std::int64_t>(c.emitted - (c.alive + c.left + c.landed + c.vanished));
}

std::string hash_text(std::uint64_t hash)
{
    return fmt::format("{:016x}", hash);
}

std::vector<Skip> simulation_skips(const World& world, std::uint32_t reorder_every_steps)
{
    std::vector<Skip> skips;
    if (!world.wind.turbulent)
        skips.push_back({"turbulence", "the scene's wind has none: q is neither read nor written"});
    if (world.voxels.nx == 0)
        skips.push_back({"cell-by-cell walk", "the scene has no solids but the ground"});
    if (!world.has_ground) skips.push_back({"ground contact", "the scene has no ground plane"});
    if (reorder_every_steps == 0)
        skips.push_back({"re-ordering by cell", "simulation.reorder_every_steps is 0"});
    else if (world.wind.kind != WindKind::grid)
        skips.push_back({"re-ordering by cell", "the scene's wind has no cells"});
    if (!steps_reach_walls(world))
        skips.push_back({"steps cut before walls", "no step goes farther than a voxel"});
    if (!world.snow.inertia)
        skips.push_back({"inertia", "snow.inertia is false: flakes follow the air at once"});
    if (world.snow.crossing == 0)
        skips.push_back({"crossing trajectories", "snow.crossing is 0: flakes stay in their eddies"});
    if (!advect_job(world, nullptr, {}).step.fine)
        skips.push_back({"dice for the last place", "steps are long against the rounding of places"});
    if (world.anchors.empty()) skips.push_back({"moving skies", "no emitter follows a camera or vehicle"});
    return skips;
}

void write_report(const std::filesystem::path& file, const RunReport& report, const scene::Scene& scene,
                  const World& world)
{
    Json json = {{"spindrift", build_json()},
                 {"scene", {{"name", scene.name}, {"file", scene.file.string()}, {"seed", world.seed}}}};
    json.update(machine_json(report));
    json["picture"] = {{"width_px", scene.render.width_px},
                       {"height_px", scene.render.height_px},
                       {"frames_per_s", scene.render.frames_per_s},
                       {"files", report.outputs}};
    json["interrupted"] = report.interrupted;
    json["steps"] = report.steps;
    json["step_s"] = world.step_s;
    json["frames"] = report.frames;
    json["wall_s"] = report.wall_s;
    json["state_hash"] = hash_text(report.state_hash);
    json["counts"] = counts_json(report.counts);
    json["counts"]["rogue"] = report.extent.rogue;
    json["bounds"] = bounds_json(report.extent, scene);
    json["reorder_every_steps"] = scene.reorder_every_steps;
    json["draw_list"] = drawn_json(report.flakes);
    json["stages_ms"] = stages_json(report.stages);
    json["passes"] = passes_json(report.passes);
    json["skipped"] = skips_json(report);
    json["memory"] = memory_json(report, world);
    json["gl_errors"] = report.gl_errors;
    const std::string text = json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
    image::write_whole(file, std::as_bytes(std::span(text)));
}

}  // namespace spindrift::app
