// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "core/advect_job.h"
#include "core/blown_wind.h"
#include "core/world.h"

namespace spindrift::cpu
{

/// A World as the kernels read it: its wind cells in large pages (a flake reads eight cache lines of them at
/// random places, most of the cost of which would else be address translation), its clearances with room to
/// read beyond.
class HeldWorld
{
  public:
    explicit HeldWorld(const World& world);

    /// All but the wind cells, which are empty here.
    const World& data() const { return data_; }

    /// Brings the wind to a step, on the threads of the current arena; a wind that stays as it is costs
    /// nothing.
    void blow(std::uint64_t step);

    /// The job of any step, but for its number, flakes and regions.
    AdvectJob job() const;

  private:
    void prepare_to_blow();

    struct Unmap
    {
        std::size_t bytes = 0;
        void operator()(void* p) const;
    };

    World data_;
    int relaxations_;
    bool near_walls_;
    std::vector<WindCell> states_;  ///< empty: the wind stays as it is
    std::vector<double> times_s_;
    std::vector<float> stream_;
    std::vector<BodyView> bodies_;
    std::vector<MovingBody> moving_;
    BlownWind blown_;
    std::unique_ptr<void, Unmap> cells_{nullptr, Unmap{}};
};

}  // namespace spindrift::cpu
