// SPDX-License-Identifier: MIT
#include "cuda/interop/interop_flakes.h"

#include <array>

namespace spindrift::gpu
{

namespace
{

constexpr std::size_t kState = 0;
constexpr std::size_t kLists = 1;

}  // namespace

InteropFlakes::InteropFlakes(std::size_t capacity, const GraphicsCalls& calls)
    : buffers_(capacity, gl::FlakeBuffers::Access::unmapped),
      registered_(std::array<GLuint, 2>{buffers_.state_buffer(), buffers_.list_buffer()}, calls)
{
}

FlakeAddresses InteropFlakes::map(StreamRef stream)
{
    registered_.map(stream);
    return {buffers_.flakes_at(registered_.address(kState)),
            buffers_.draw_list_at(registered_.address(kLists))};
}

void InteropFlakes::hand_over(StreamRef, std::size_t, const DrawList&)
{
    // GL draws from the same memory
}

void InteropFlakes::unmap(StreamRef stream)
{
    registered_.unmap(stream);
}

}  // namespace spindrift::gpu
