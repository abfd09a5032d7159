// SPDX-License-Identifier: MIT
#include "gl/flake_pass.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <vector>

#include "core/error.h"
#include "gl/frame_constants.h"

namespace spindrift::gl
{

namespace
{

using scene::Blending;

constexpr std::array<std::string_view, 2> kFiles{"flake.vert", "flake.frag"};
constexpr GLint kHasScene = 0;
constexpr GLint kSamples = 1;
constexpr GLint kShutter = 2;
constexpr GLint kBlocksUsed = 8;

void require_vertex_pulling()
{
    GLint blocks = 0;
    glGetIntegerv(GL_MAX_VERTEX_SHADER_STORAGE_BLOCKS, &blocks);
    if (blocks < kBlocksUsed)
        throw Error(
            fmt::format("this OpenGL driver lets vertex shaders read {} storage buffers; {} are needed",
                        blocks, kBlocksUsed));
}

/// Beyond this distance from the eye no flake reaches kCrystalRadius, wherever in the enlarged picture it is.
double plain_beyond_m(const View& view, double flake_scale)
{
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    const double depth_m =
        0.5 * FlakePass::kLargestDiameter * flake_scale * focal_px / FlakePass::kCrystalRadius;
    const double half_width = 0.5 * view.width_px + view.guard_px;
    const double half_height = 0.5 * view.height_px + view.guard_px;
    return depth_m * std::hypot(1.0, half_width / focal_px, half_height / focal_px);
}

double distance_m(const View& view, const FlakeView& flakes, std::uint64_t pair)
{
    const auto slot = static_cast<std::uint32_t>(pair);
    return std::hypot(static_cast<double>(flakes.x[slot]) - view.eye.x,
                      static_cast<double>(flakes.y[slot]) - view.eye.y,
                      static_cast<double>(flakes.z[slot]) - view.eye.z);
}

}  // namespace

FlakePass::FlakePass(const scene::RenderSettings& settings, double weight, const FlakeBuffers& buffers)
    : settings_(settings), buffers_(buffers), nothing_(make_vertex_array())
{
    require_vertex_pulling();
    if (buffers.access() == FlakeBuffers::Access::unmapped) split_.emplace();
    std::vector<std::string_view> defines;
    if (settings.blending == Blending::opaque)
        defines.emplace_back("OPAQUE");
    else if (weight != settings.flake_scale * settings.flake_scale)
        defines.emplace_back("WEIGHTED");
    if (settings.blending == Blending::additive) defines.emplace_back("ADDITIVE");
    if (settings.blending == Blending::weighted) defines.emplace_back("SHARED");
    if (settings.blending == Blending::stochastic) defines.emplace_back("SAMPLED");
    if (settings.shutter_s > 0) defines.emplace_back("STREAK");
    if (settings.sprite == scene::Sprite::point) defines.emplace_back("POINT_SPRITE");
    programs_[kPlain] = ByAir(kFiles, defines);
    if (settings.blending == Blending::opaque) return;
    defines.emplace_back("LARGE");
    programs_[kCrystal] = ByAir(kFiles, defines);
}

void FlakePass::bind(const FlakeDraw& what) const
{
    const GLuint state = buffers_.state_buffer();
    const auto bytes = static_cast<GLsizeiptr>(buffers_.array_stride() * 4);
    constexpr int kIds = 9;  // array of FlakeView
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kXArray, state, 0, bytes);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kYArray, state, bytes, bytes);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kZArray, state, 2 * bytes, bytes);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kIdArray, state, kIds * bytes, bytes);
    const auto list_bytes = static_cast<GLsizeiptr>(buffers_.list_stride() * 8);
    glBindBufferRange(GL_SHADER_STORAGE_BUFFER, kDrawList, buffers_.list_buffer(),
                      what.list.in_scratch ? list_bytes : 0, list_bytes);
    glBindTextureUnit(kSceneDepth, what.scene_depth);
    if (what.velocities != 0) glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kFlakeVelocities, what.velocities);
}

void FlakePass::set_blending() const
{
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    const bool covers = settings_.blending == Blending::opaque || settings_.blending == Blending::stochastic;
    glDepthMask(covers ? GL_TRUE : GL_FALSE);
    if (covers)
    {
        glDisable(GL_BLEND);
        return;
    }
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    if (settings_.blending == Blending::additive)
        glBlendFuncSeparate(GL_ONE, GL_ONE, GL_ZERO, GL_ONE);
    else
        glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    if (settings_.blending != Blending::weighted) return;
    glBlendFunci(0, GL_ONE, GL_ONE);
    glBlendFunci(1, GL_ZERO, GL_ONE_MINUS_SRC_COLOR);
}

GLsizei FlakePass::count_beyond(const FlakeDraw& what, double border_m) const
{
    const FlakeView flakes = buffers_.flakes();
    const DrawListView lists = buffers_.draw_list();
    const std::uint64_t* pairs = what.list.in_scratch ? lists.scratch : lists.pairs;
    GLsizei low = 0;
    auto high = static_cast<GLsizei>(what.list.count);
    while (low < high)
    {
        const GLsizei middle = low + (high - low) / 2;
        if (distance_m(what.view, flakes, pairs[middle]) > border_m)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

void FlakePass::use(const FlakeDraw& what, Detail detail) const
{
    const GLuint program = programs_[detail].in(what.air).for_lights(what.lights);
    glUseProgram(program);
    if (settings_.blending != Blending::opaque)
        glProgramUniform1i(program, kHasScene, what.scene_depth != 0 ? 1 : 0);
    if (settings_.blending == Blending::stochastic)
        glProgramUniform3i(program, kSamples, what.samples.first, what.samples.count, what.samples.all);
    if (settings_.shutter_s > 0)
        glProgramUniform1f(program, kShutter, static_cast<float>(settings_.shutter_s));
}

void FlakePass::draw_range(const FlakeDraw& what, Detail detail, GLsizei first, GLsizei count) const
{
    if (count == 0) return;
    use(what, detail);
    glDrawArrays(GL_POINTS, first, count);
}

void FlakePass::draw_points(const FlakeDraw& what) const
{
    const auto count = static_cast<GLsizei>(what.list.count);
    if (settings_.blending == Blending::opaque) return draw_range(what, kPlain, 0, count);
    if (!what.list.sorted) return draw_range(what, kCrystal, 0, count);
    // Far to near: the plain ones come first.
    const double border_m = plain_beyond_m(what.view, settings_.flake_scale);
    if (!split_)
    {
        const GLsizei plain = count_beyond(what, border_m);
        draw_range(what, kPlain, 0, plain);
        draw_range(what, kCrystal, plain, count - plain);
        return;
    }
    split_->search(count, what.view.eye, border_m);
    use(what, kPlain);
    glDrawArraysIndirect(GL_POINTS, FlakeSplit::beyond());
    use(what, kCrystal);
    glDrawArraysIndirect(GL_POINTS, FlakeSplit::within());
}

void FlakePass::draw(const FlakeDraw& what) const
{
    if (what.list.count == 0) return;
    if (what.list.count > buffers_.capacity())
        throw Error("the draw list is longer than the flakes' capacity");
    bind(what);
    set_blending();
    // A point is clipped when its centre leaves the viewport: one that is larger than the picture by the
    // guard band keeps sprites that still reach into the picture. The scissor keeps the picture's own border.
    const auto guard = static_cast<GLint>(std::lround(what.view.guard_px));
    glViewport(-guard, -guard, what.view.width_px + 2 * guard, what.view.height_px + 2 * guard);
    glEnable(GL_SCISSOR_TEST);
    glScissor(0, 0, what.view.width_px, what.view.height_px);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glBindVertexArray(nothing_.name());
    draw_points(what);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glViewport(0, 0, what.view.width_px, what.view.height_px);
}

}  // namespace spindrift::gl
