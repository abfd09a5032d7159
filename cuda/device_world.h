// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/advect_job.h"
#include "core/anchors.h"
#include "core/world.h"
#include "cuda/buffer.h"
#include "cuda/step_control.h"

namespace spindrift::gpu
{

/// A World in device memory, and what a run changes beside its flakes.
class DeviceWorld
{
  public:
    /// Copies and waits. Throws Error if the device has no room.
    DeviceWorld(const World& world, const Anchors& anchors);

    /// Of any step, but for its number, flakes and regions.
    const AdvectJob& job() const { return job_; }
    const StepAddresses& step() const { return step_; }

    /// Queues a copy of where the anchors are.
    void place_anchors(StreamRef stream, const Anchors& anchors);

    /// Two numbers an emitter, as cpu::Emission::save; both wait.
    void save_emission(StreamRef stream, std::vector<std::uint64_t>& words) const;
    void restore_emission(StreamRef stream, const std::uint64_t* words);
    void restore_control(StreamRef stream, const StepControl& control);

  private:
    void prepare_to_blow(const World& world);
    std::size_t emitter_count() const { return emitters_.size(); }

    DeviceBuffer<WindCell> cells_, states_;
    DeviceBuffer<double> times_;
    DeviceBuffer<float> gust_share_, stream_;
    DeviceBuffer<Anchor::Key> body_keys_;
    DeviceBuffer<BodyView> bodies_;
    DeviceBuffer<MovingBody> moving_;
    DeviceBuffer<std::uint8_t> clearance_, surface_;
    DeviceBuffer<Surface> surfaces_;
    DeviceBuffer<Emitter> emitters_;
    DeviceBuffer<Anchor::Key> keys_;
    DeviceBuffer<AnchorView> anchors_;
    DeviceBuffer<std::uint64_t> owed_, waiting_, ends_;
    DeviceBuffer<std::uint32_t> lost_;
    DeviceBuffer<Region> regions_before_, regions_after_;
    DeviceBuffer<StepControl> control_;
    AdvectJob job_;
    StepAddresses step_;
};

}  // namespace spindrift::gpu
