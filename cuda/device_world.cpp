// SPDX-License-Identifier: MIT
#include "cuda/device_world.h"

#include <algorithm>

#include "core/gradient_reach.h"

namespace spindrift::gpu
{

namespace
{

std::vector<WindCell> spread_cells(const World& world)
{
    const Wind& wind = world.wind;
    std::vector<WindCell> cells = wind.cells;
    if (wind.turbulent && !cells.empty())
        spread_gradients(cells.data(), wind.nx, wind.ny, wind.nz, wind.cell_m,
                         world.step_s / relaxations(world));
    return cells;
}

/// The anchors with their keys' addresses on the device.
std::vector<AnchorView> device_views(const Anchors& anchors, const Anchor::Key* keys)
{
    std::vector<AnchorView> views = anchors.views();
    for (AnchorView& view : views)
    {
        view.keys = keys;
        keys += view.count;
    }
    return views;
}

/// Queues a copy from memory that need not stay: the runtime takes pageable memory before it returns.
template <class T>
void copy_now(StreamRef stream, T* device, const T* host, std::size_t count)
{
    if (count > 0) copy_to_device(stream, device, host, count);
}

}  // namespace

DeviceWorld::DeviceWorld(const World& world, const Anchors& anchors)
    : cells_(spread_cells(world)),
      clearance_(world.voxels.clearance),
      surface_(world.voxels.surface),
      surfaces_(world.surfaces),
      emitters_(world.emitters),
      keys_(anchors.keys()),
      anchors_(device_views(anchors, keys_.data())),
      owed_(std::vector<std::uint64_t>(emitter_count())),
      waiting_(std::vector<std::uint64_t>(emitter_count())),
      ends_(std::vector<std::uint64_t>(emitter_count())),
      lost_(std::vector<std::uint32_t>(emitter_count())),
      regions_before_(std::max<std::size_t>(emitter_count(), 1)),
      regions_after_(regions_before_.size()),
      control_(std::vector<StepControl>(1))
{
    if (world.wind.changes()) prepare_to_blow(world);
    Solids solids = solids_view(world);
    solids.voxels.clearance = clearance_.data();
    solids.voxels.surface = surface_.data();
    solids.surfaces = surfaces_.data();
    job_ = advect_job(world, cells_.data(), solids);
    job_.step.relaxations = relaxations(world);
    job_.step.near_walls = steps_reach_walls(world);
    step_.control = control_.data();
    step_.ledger = {emitters_.data(), emitter_count(), world.step_s,
                    owed_.data(),     waiting_.data(), ends_.data()};
    step_.lost = lost_.data();
    step_.place = {emitters_.data(), emitter_count(), anchors_.data(), world.size_m};
    step_.regions_before = regions_before_.data();
    step_.regions_after = regions_after_.data();
    step_.step_s = world.step_s;
    step_.capacity = world.capacity;
}

void DeviceWorld::prepare_to_blow(const World& world)
{
    const Wind& wind = world.wind;
    BlownWind& blown = step_.blown;
    blown = blown_wind(wind, world.step_s);
    std::vector<double> times;
    states_ = DeviceBuffer<WindCell>(spread_states(world, times));
    times_ = DeviceBuffer<double>(times);
    blown.states = {states_.data(), times_.data(), times_.size(), cells_.size(), cells_.data()};
    gust_share_ = DeviceBuffer<float>(wind.gust_share);
    blown.gust_share = gust_share_.data();
    if (wind.gusts.speed_m_s > 0)
    {
        stream_ = DeviceBuffer<float>((static_cast<std::size_t>(wind.nx) + 2) *
                                      (static_cast<std::size_t>(wind.ny) + 2));
        blown.stream_m2_s = stream_.data();
    }
    std::vector<Anchor::Key> keys;
    for (const Body& body : wind.bodies)
        keys.insert(keys.end(), body.path.keys.begin(), body.path.keys.end());
    body_keys_ = DeviceBuffer<Anchor::Key>(keys);
    std::vector<BodyView> views;
    std::size_t first = 0;
    for (const Body& body : wind.bodies)
    {
        const std::size_t count = body.path.keys.size();
        views.push_back(
            {{body_keys_.data() + first, static_cast<std::uint32_t>(count), false, {}}, body.size_m});
        first += count;
    }
    bodies_ = DeviceBuffer<BodyView>(views);
    moving_ = DeviceBuffer<MovingBody>(views.size());
    blown.bodies = bodies_.data();
    blown.moving = moving_.data();
}

void DeviceWorld::place_anchors(StreamRef stream, const Anchors& anchors)
{
    const std::vector<AnchorView> views = device_views(anchors, keys_.data());
    copy_now(stream, anchors_.data(), views.data(), views.size());
}

void DeviceWorld::save_emission(StreamRef stream, std::vector<std::uint64_t>& words) const
{
    const std::size_t n = emitter_count();
    const std::size_t first = words.size();
    words.resize(first + 2 * n);
    if (n == 0) return;
    copy_to_host(stream, words.data() + first, owed_.data(), n);
    copy_to_host(stream, words.data() + first + n, waiting_.data(), n);
    stream.wait();
}

void DeviceWorld::restore_emission(StreamRef stream, const std::uint64_t* words)
{
    copy_now(stream, owed_.data(), words, emitter_count());
    copy_now(stream, waiting_.data(), words + emitter_count(), emitter_count());
    stream.wait();
}

void DeviceWorld::restore_control(StreamRef stream, const StepControl& control)
{
    copy_now(stream, control_.data(), &control, 1);
    stream.wait();
}

}  // namespace spindrift::gpu
