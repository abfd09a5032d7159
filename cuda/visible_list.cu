// SPDX-License-Identifier: MIT
#include "cuda/visible_list.h"

#include "core/emission_order.h"
#include "core/visible.h"
#include "cuda/launch.cuh"
#include "cuda/selection.cuh"

namespace spindrift::gpu
{

namespace
{

struct IsVisible
{
    VisibleFlakes<float> flakes;
    __device__ bool operator()(std::size_t i) const { return flakes.sees(i, flakes.offset(i)); }
};

struct WritePair
{
    VisibleFlakes<float> flakes;
    std::uint64_t* pairs;
    __device__ void operator()(std::size_t i, std::uint32_t rank) const
    {
        pairs[rank] = draw_list_pair(flakes.key(flakes.offset(i)), i);
    }
};

}  // namespace

void list_visible(StreamRef stream, StepControl* control, std::size_t capacity, const FlakeAddresses& at,
                  const Frustum& frustum, const Selection& selection)
{
    const VisibleFlakes<float> flakes{frustum, at.flakes};
    select(stream, "list visible flakes", &control->used, capacity, selection, &control->visible,
           IsVisible{flakes}, WritePair{flakes, at.draw_list.pairs});
}

void order_ties(StreamRef stream, std::uint64_t* pairs, std::size_t n, const std::uint32_t* id,
                std::uint32_t next_id)
{
    launch(stream, "order ties", n, EmissionOrder{pairs, n, id, next_id});
}

}  // namespace spindrift::gpu
