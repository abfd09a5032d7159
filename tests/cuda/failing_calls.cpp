// SPDX-License-Identifier: MIT
#include "tests/cuda/failing_calls.h"

#include <algorithm>
#include <map>
#include <optional>

namespace spindrift::gpu
{

namespace
{

using Which = FailingCalls::Which;

struct State
{
    Which which = Which::none;
    cudaError_t code = cudaSuccess;
    int after = 0;
    std::optional<int> device;
    void* misdirected = nullptr;
    FailingCalls::Counts counts;
    std::map<cudaGraphicsResource_t, GLuint> buffers;
};

State state;

/// Whether this call is to fail; the runtime then remembers an error, as it does for a real one.
bool fails(Which which)
{
    if (state.which != which || state.after-- > 0) return false;
    cudaGraphicsUnregisterResource(nullptr);
    return true;
}

cudaError_t devices(unsigned* count, int* ordinals, unsigned room, cudaGLDeviceList list)
{
    if (fails(Which::devices)) return state.code;
    if (!state.device) return cudaGLGetDevices(count, ordinals, room, list);
    *count = *state.device == FailingCalls::kNoDevice ? 0 : 1;
    ordinals[0] = *state.device;
    return cudaSuccess;
}

cudaError_t register_buffer(cudaGraphicsResource** resource, GLuint buffer, unsigned flags)
{
    if (fails(Which::registering)) return state.code;
    const cudaError_t code = cudaGraphicsGLRegisterBuffer(resource, buffer, flags);
    if (code != cudaSuccess) return code;
    ++state.counts.registered;
    state.buffers[*resource] = buffer;
    return code;
}

cudaError_t unregister(cudaGraphicsResource_t resource)
{
    ++state.counts.unregistered;
    if (glIsBuffer(state.buffers[resource]) == GL_FALSE) ++state.counts.unregistered_after_gl_freed;
    return cudaGraphicsUnregisterResource(resource);
}

cudaError_t map(int count, cudaGraphicsResource_t* resources, cudaStream_t stream)
{
    if (fails(Which::mapping)) return state.code;
    ++state.counts.map_calls;
    state.counts.most_mapped_at_once = std::max(state.counts.most_mapped_at_once, count);
    return cudaGraphicsMapResources(count, resources, stream);
}

cudaError_t unmap(int count, cudaGraphicsResource_t* resources, cudaStream_t stream)
{
    ++state.counts.unmap_calls;
    const cudaError_t code = cudaGraphicsUnmapResources(count, resources, stream);
    return fails(Which::unmapping) ? state.code : code;
}

cudaError_t address(void** memory, std::size_t* bytes, cudaGraphicsResource_t resource)
{
    if (fails(Which::addresses)) return state.code;
    const cudaError_t code = cudaGraphicsResourceGetMappedPointer(memory, bytes, resource);
    if (state.misdirected != nullptr) *memory = state.misdirected;
    return code;
}

}  // namespace

FailingCalls::FailingCalls(Which which, cudaError_t code, int after)
{
    state = {};
    state.which = which;
    state.code = code;
    state.after = after;
}

GraphicsCalls FailingCalls::calls() const
{
    return {devices, register_buffer, unregister, map, unmap, address};
}

void FailingCalls::name_device(int ordinal)
{
    state.device = ordinal;
}

void FailingCalls::misdirect_kernels(void* memory)
{
    state.misdirected = memory;
}

FailingCalls::Counts FailingCalls::counts() const
{
    return state.counts;
}

}  // namespace spindrift::gpu
