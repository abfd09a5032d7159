// SPDX-License-Identifier: MIT
#include "cuda/interop/gather.h"

#include "cuda/launch.cuh"

namespace spindrift::gpu
{

namespace
{

struct DrawnGatherer
{
    FlakeView flakes;
    const std::uint64_t* pairs;
    std::uint32_t* to;
    std::size_t stride;

    __device__ void operator()(std::size_t i) const
    {
        const auto slot = static_cast<std::uint32_t>(pairs[i]);
        to[i] = __float_as_uint(flakes.x[slot]);
        to[stride + i] = __float_as_uint(flakes.y[slot]);
        to[2 * stride + i] = __float_as_uint(flakes.z[slot]);
        to[3 * stride + i] = flakes.id[slot];
    }
};

}  // namespace

void gather_drawn(StreamRef stream, const FlakeView& flakes, const std::uint64_t* pairs, std::size_t count,
                  std::uint32_t* to, std::size_t stride)
{
    launch(stream, "gather drawn flakes", count, DrawnGatherer{flakes, pairs, to, stride});
}

}  // namespace spindrift::gpu
