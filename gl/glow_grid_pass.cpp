// SPDX-License-Identifier: MIT
#include "gl/glow_grid_pass.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "core/airlight.h"

namespace spindrift::gl
{

namespace
{

constexpr unsigned kGroup = 32;  // of glow_grid.comp
constexpr unsigned kColumns = (GlowGrid::kRings + 1) * (GlowGrid::kTurns + 1);
/// Points at which a grid's making asks for the light.
constexpr double kPoints = 2.0 * kColumns * GlowGrid::kSteps;
/// A grid must spare this many times the points that it costs.
constexpr double kWorth = 2;

/// Pixels from which a way begins that the lamp lights, at most.
double lit_px(const Lamp<float>& lamp, const View& view)
{
    const double all = static_cast<double>(view.width_px) * view.height_px;
    const Vec3f away = lamp.position_m - view.eye;
    const double range2 = static_cast<double>(lamp.range_m) * lamp.range_m;
    const double away2 = static_cast<double>(dot(away, away));
    if (away2 <= range2) return all;
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    return std::min(all, std::numbers::pi * focal_px * focal_px * range2 / (away2 - range2));
}

}  // namespace

std::vector<std::int32_t> lamps_in_grids(std::span<const Lamp<float>> lamps, std::size_t shadowed,
                                         const View& view, double flakes)
{
    const double pixels = static_cast<double>(view.width_px) * view.height_px;
    const double ways_per_px = 1 + flakes / pixels;
    std::vector<std::int32_t> of_lamp;
    std::int32_t grids = 0;
    for (std::size_t i = 0; i < lamps.size(); ++i)
    {
        const Lamp<float>& lamp = lamps[i];
        const bool fits = lamp.kind == LampKind::point && std::isfinite(lamp.range_m) && i >= shadowed;
        const bool pays = fits && lit_px(lamp, view) * ways_per_px * kAirlightPoints > kWorth * kPoints;
        of_lamp.push_back(pays ? grids++ : -1);
    }
    return of_lamp;
}

std::size_t count_grids(std::span<const std::int32_t> of_lamp)
{
    return static_cast<std::size_t>(
        std::count_if(of_lamp.begin(), of_lamp.end(), [](std::int32_t number) { return number >= 0; }));
}

void GlowGridPass::fill(const Room& room)
{
    if (!program_)
        program_ = make_program(std::array<std::string_view, 1>{"glow_grid.comp"},
                                std::array<std::string_view, 3>{"AIR", "GLOW_GRIDS", "FILLS_GRIDS"});
    glUseProgram(program_.name());
    glDispatchCompute((kColumns + kGroup - 1) / kGroup, static_cast<GLuint>(room.of_lamp.size()), 1);
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

GlowGrids GlowGridPass::on_host(const Room& room)
{
    nodes_.resize(count_grids(room.of_lamp) * GlowGrid::count());
    if (nodes_.empty()) return {};
    glGetNamedBufferSubData(room.buffer, static_cast<GLintptr>(room.nodes_at * 4),
                            static_cast<GLsizeiptr>(nodes_.size() * 4), nodes_.data());
    return {room.of_lamp.data(), nodes_.data()};
}

}  // namespace spindrift::gl
