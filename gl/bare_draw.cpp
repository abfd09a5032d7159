// SPDX-License-Identifier: MIT
#include "gl/bare_draw.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <vector>

#include "core/snow.h"
#include "gl/flake_look.h"
#include "gl/object.h"
#include "gl/picture.h"
#include "gl/program.h"

namespace spindrift::gl
{

namespace
{

constexpr std::array<std::string_view, 2> kFiles{"bare.vert", "bare.frag"};

using Point = std::array<float, 4>;

std::vector<Point> place_points(const scene::Scene& scene, const World& world, const FlakeBuffers& buffers,
                                const View& view, const DrawList& list)
{
    const FlakeView flakes = buffers.flakes();
    const DrawListView lists = buffers.draw_list();
    const std::uint64_t* pairs = list.in_scratch ? lists.scratch : lists.pairs;
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    const double half_width = 0.5 * view.width_px + static_cast<double>(view.guard_px);
    const double half_height = 0.5 * view.height_px + static_cast<double>(view.guard_px);
    const FlakeSizes sizes(world.snow, world.seed);
    const SpriteLimits limits = sprite_limits(view);
    std::vector<Point> points;
    points.reserve(list.count);
    for (std::uint64_t i = 0; i < list.count; ++i)
    {
        const auto slot = static_cast<std::uint32_t>(pairs[i]);
        const Vec3f rel = Vec3f{flakes.x[slot], flakes.y[slot], flakes.z[slot]} - view.eye;
        const double z = dot(rel, view.forward);
        const double px_per_m = focal_px / z;
        const double radius =
            0.5 * sizes.diameter_m<double>(flakes.id[slot]) * scene.render.flake_scale * px_per_m;
        points.push_back({static_cast<float>(dot(rel, view.right) * px_per_m / half_width),
                          static_cast<float>(dot(rel, view.up) * px_per_m / half_height),
                          static_cast<float>(view.near_m / z),
                          2 * std::clamp(static_cast<float>(radius), limits.smallest_px, limits.largest_px)});
    }
    return points;
}

}  // namespace

struct BareDraw::Impl
{
    View view;
    Picture picture;
    Program program = make_program(kFiles);
    Buffer points;
    VertexArray array = make_vertex_array();
    GLsizei count;

    Impl(const View& v, const std::vector<Point>& p)
        : view(v),
          picture(v.width_px, v.height_px),
          points(make_buffer(static_cast<GLsizeiptr>(p.size() * sizeof(Point)), p.data(), 0)),
          count(static_cast<GLsizei>(p.size()))
    {
        glVertexArrayVertexBuffer(array.name(), 0, points.name(), 0, sizeof(Point));
        glEnableVertexArrayAttrib(array.name(), 0);
        glVertexArrayAttribFormat(array.name(), 0, 4, GL_FLOAT, GL_FALSE, 0);
        glVertexArrayAttribBinding(array.name(), 0, 0);
    }
};

BareDraw::BareDraw(const scene::Scene& scene, const World& world, const FlakeBuffers& buffers,
                   const View& view, const DrawList& flakes)
    : impl_(std::make_unique<Impl>(view, place_points(scene, world, buffers, view, flakes)))
{
}
BareDraw::~BareDraw() = default;

void BareDraw::draw() const
{
    const Impl& m = *impl_;
    const auto guard = static_cast<GLint>(std::lround(m.view.guard_px));
    glBindFramebuffer(GL_FRAMEBUFFER, m.picture.linear_target.name());
    constexpr std::array<GLfloat, 4> black{0, 0, 0, 1};
    constexpr GLfloat far_depth = 0;
    glDepthMask(GL_TRUE);
    glDisable(GL_SCISSOR_TEST);
    glClearNamedFramebufferfv(m.picture.linear_target.name(), GL_COLOR, 0, black.data());
    glClearNamedFramebufferfv(m.picture.linear_target.name(), GL_DEPTH, 0, &far_depth);
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    glViewport(-guard, -guard, m.view.width_px + 2 * guard, m.view.height_px + 2 * guard);
    glScissor(0, 0, m.view.width_px, m.view.height_px);
    glEnable(GL_SCISSOR_TEST);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_GREATER);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_PROGRAM_POINT_SIZE);
    glUseProgram(m.program.name());
    glBindVertexArray(m.array.name());
    glDrawArrays(GL_POINTS, 0, m.count);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glFinish();
}

}  // namespace spindrift::gl
