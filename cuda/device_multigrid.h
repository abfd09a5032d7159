// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "core/poisson_levels.h"
#include "cuda/buffer.h"
#include "cuda/captured_graph.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// As cpu::Multigrid, step by step: the same bits.
class DeviceMultigrid
{
  public:
    /// Copies the grids and waits. Throws Error if the device has no room.
    DeviceMultigrid(StreamRef stream, const std::vector<PoissonLevel>& levels);

    FaceCoefficients coefficients() const { return levels_.front().coefficients(); }
    const float* inverse_diagonal() const { return levels_.front().inverse_diagonal.data(); }

    /// Right-hand side and result of cycle(), on the finest grid; the border holds zeros.
    float* right_hand_side() const { return levels_.front().b.data(); }
    const float* result() const { return levels_.front().u.data(); }

    /// Queues one V-cycle from zero, as a graph that is recorded the first time.
    void cycle(StreamRef stream);

  private:
    struct Level
    {
        PaddedBox box;
        std::array<DeviceBuffer<float>, 3> face, open, toward;
        std::array<int, 3> halved;
        DeviceBuffer<float> inverse_diagonal, u, b, r;

        Level(StreamRef stream, const PoissonLevel& grid);
        FaceCoefficients coefficients() const
        {
            return {face[0].data(), face[1].data(), face[2].data(), box.row(), box.plane()};
        }
        AxisMap map(int axis) const { return {toward[axis].data() + 2, halved[axis]}; }
    };

    void queue_cycle(StreamRef stream, std::size_t level) const;
    static void solve_coarsest(StreamRef stream, const Level& level);
    static void smooth(StreamRef stream, const Level& level, int colour);
    static void smooth_from_zero(StreamRef stream, const Level& level);
    static void take_residual(StreamRef stream, const Level& level);
    static void restrict_to(StreamRef stream, const Level& coarse, const Level& fine);
    static void prolong(StreamRef stream, const Level& fine, const Level& coarse);

    std::vector<Level> levels_;
    std::optional<CapturedGraph> cycle_;
};

}  // namespace spindrift::gpu
