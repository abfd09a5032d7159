// SPDX-License-Identifier: MIT
#include "tests/golden/gl_picture.h"

#include <algorithm>
#include <cstring>
#include <numeric>

#include "core/backend.h"
#include "cpu/tile_splatter.h"
#include "gl/context.h"
#include "gl/flake_buffers.h"
#include "gl/frame_plan.h"
#include "gl/renderer.h"

namespace spindrift::golden
{

namespace
{

void copy_flakes(const StillFlakes& from, const FlakeView& to)
{
    std::copy(from.x.begin(), from.x.end(), to.x);
    std::copy(from.y.begin(), from.y.end(), to.y);
    std::copy(from.z.begin(), from.z.end(), to.z);
    std::copy(from.id.begin(), from.id.end(), to.id);
    std::copy(from.state.begin(), from.state.end(), to.state);
}

/// All slots, far to near by distances in double, equal ones by id.
std::vector<std::uint32_t> order_of(const StillFlakes& flakes, const View& view)
{
    const auto distance2 = [&](std::uint32_t i)
    {
        const double dx = double{flakes.x[i]} - view.eye.x, dy = double{flakes.y[i]} - view.eye.y,
                     dz = double{flakes.z[i]} - view.eye.z;
        return dx * dx + dy * dy + dz * dz;
    };
    std::vector<std::uint32_t> slots(flakes.x.size());
    std::iota(slots.begin(), slots.end(), 0U);
    std::sort(slots.begin(), slots.end(),
              [&](std::uint32_t a, std::uint32_t b)
              {
                  const double da = distance2(a), db = distance2(b);
                  return da != db ? da > db : flakes.id[a] < flakes.id[b];
              });
    return slots;
}

}  // namespace

GlPicture draw_with_gl(SmallScene& small, Order order)
{
    return draw_with_gl(small, *cpu::make_tile_splatter({}), order);
}

GlPicture draw_with_gl(SmallScene& small, Splatter& splatter, Order order)
{
    const std::size_t count = small.flakes.x.size();
    const gl::FlakeBuffers buffers(std::max<std::size_t>(count, 1));
    copy_flakes(small.flakes, buffers.flakes());
    std::uint64_t rank = 0;
    std::vector<std::uint32_t> slots = order_of(small.flakes, small.view);
    if (order == Order::near_to_far) std::reverse(slots.begin(), slots.end());
    for (const std::uint32_t slot : slots)
    {
        buffers.draw_list().pairs[rank] = rank << 32U | slot;
        ++rank;
    }
    DrawList list;
    list.count = count;
    list.sorted = order == Order::far_to_near;
    list.slots = count;

    gl::FrameStats stats;
    stats.counts.emitted = stats.counts.alive = count;
    const gl::FramePlan plan =
        gl::plan_frame(small.scene, small.view, stats, small.time_s, small.geometry.model_lights);
    gl::Renderer renderer(small.scene, small.geometry, small.world, buffers, small.view.width_px,
                          small.view.height_px, &splatter);
    renderer.draw(plan, small.view, list, small.time_s);
    return {renderer.read_linear(), renderer.read_display(), gl::Context::debug_errors()};
}

}  // namespace spindrift::golden
