// SPDX-License-Identifier: MIT
#include "app/camera_path.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

#include "core/error.h"
#include "cpu/cpu_backend.h"
#include "cpu/wind_projection.h"
#include "image/compare.h"
#include "scene/make_world.h"

namespace spindrift::app
{

CameraPath::CameraPath(scene::Scene scene)
    : scene_(std::move(scene)),
      geometry_(scene::read_geometry(scene_)),
      world_(scene::make_world(scene_, geometry_, cpu::project_wind())),
      clock_{scene_.render.warm_up_s, scene_.render.frames_per_s, world_.step_s}
{
    try
    {
        context_ = gl::make_headless_context();
    }
    catch (const Error& error)
    {
        no_gl_because_ = error.what();
    }
    auto memory = context_ ? make_shared_memory(world_.capacity) : make_host_memory(world_.capacity);
    flakes_ = memory->flakes();
    draw_list_ = memory->draw_list();
    auto backend = cpu::make_cpu_backend(world_, flakes_, draw_list_, {});
    simulator_ = std::make_unique<Simulator>(std::move(memory), std::move(backend), log_);
    if (context_)
        renderer_.emplace(scene_, geometry_, world_, *simulator_->memory().drawn_from(),
                          scene_.render.width_px, scene_.render.height_px);
}

CameraPath::~CameraPath() = default;

void CameraPath::go_to(std::uint64_t frame)
{
    simulator_->advance_to(clock_.steps_before(frame), [] { return false; });
    time_s_ = clock_.time_s(frame);
    view_ = scene::camera_at(scene_, time_s_);
    exact_picture_.reset();
}

KeysOfFrame CameraPath::keys()
{
    KeysOfFrame keys;
    const std::uint64_t* const pairs = draw_list_.pairs;
    for (std::size_t i = 0; i < keys.pairs.size(); ++i)
    {
        const DrawList list =
            simulator_->prepare(view_, {.strategy = "none", .depth_bits = KeysOfFrame::kBits[i]});
        keys.pairs[i].assign(pairs, pairs + list.count);
    }
    keys.sources = moves();
    ids_.assign(flakes_.id, flakes_.id + simulator_->backend().slots_used());
    return keys;
}

/// The backend does not say where flakes went; their ids do. As KeysOfFrame::sources.
std::vector<std::uint32_t> CameraPath::moves() const
{
    const std::span ids(flakes_.id, simulator_->backend().slots_used());
    const std::size_t both = std::min(ids.size(), ids_.size());
    if (std::equal(ids_.begin(), ids_.begin() + static_cast<std::ptrdiff_t>(both), ids.begin())) return {};
    std::unordered_map<std::uint32_t, std::uint32_t> slots;
    for (std::uint32_t slot = 0; slot < ids_.size(); ++slot) slots[ids_[slot]] = slot;
    std::vector<std::uint32_t> sources(ids.size());
    std::ranges::transform(ids, sources.begin(),
                           [&](std::uint32_t id)
                           {
                               const auto found = slots.find(id);
                               return found == slots.end() ? kNoRank : found->second;
                           });
    return sources;
}

std::string CameraPath::pictures_by() const
{
    return context_ ? context_->info().renderer
                    : fmt::format("none, since there is no GL: {}", no_gl_because_);
}

image::Image CameraPath::picture(std::span<const std::uint64_t> order)
{
    std::copy(order.begin(), order.end(), draw_list_.pairs);
    DrawList list;
    list.count = order.size();
    list.sorted = true;
    gl::FrameStats stats;
    stats.counts = simulator_->backend().counts();
    renderer_->draw(gl::plan_frame(scene_, view_, stats, time_s_, geometry_.model_lights), view_, list,
                    time_s_);
    renderer_->wait_for_flakes();
    return renderer_->read_linear();
}

double CameraPath::picture_error(std::span<const std::uint64_t> order, std::span<const std::uint64_t> exact)
{
    if (!exact_picture_) exact_picture_ = picture(exact);
    return image::compare(picture(order), *exact_picture_, 0).relative_l2;
}

}  // namespace spindrift::app
