// SPDX-License-Identifier: MIT
#include "cuda/interop/registered_buffers.h"

#include "core/error.h"

namespace spindrift::gpu
{

namespace
{

// Not WriteDiscard: kernels read back what they and their predecessors wrote, in the state as well as in the
// draw list.
constexpr unsigned kReadAndWritten = cudaGraphicsRegisterFlagsNone;

}  // namespace

RegisteredBuffers::RegisteredBuffers(std::span<const GLuint> buffers, const GraphicsCalls& calls)
    : calls_(calls)
{
    for (const GLuint buffer : buffers)
    {
        cudaGraphicsResource_t resource = nullptr;
        const cudaError_t code = calls_.register_buffer(&resource, buffer, kReadAndWritten);
        if (code != cudaSuccess)
        {
            unregister();
            throw_call_failed(code, "cudaGraphicsGLRegisterBuffer");
        }
        resources_.push_back(resource);
    }
}

RegisteredBuffers::~RegisteredBuffers()
{
    // An exception has passed between map() and unmap(): nobody waits for the kernels any more.
    if (!addresses_.empty()) calls_.unmap(static_cast<int>(resources_.size()), resources_.data(), nullptr);
    unregister();
}

void RegisteredBuffers::unregister() noexcept
{
    for (const cudaGraphicsResource_t resource : resources_) calls_.unregister(resource);
    resources_.clear();
    cudaGetLastError();
}

void RegisteredBuffers::map(StreamRef stream)
{
    check(calls_.map(static_cast<int>(resources_.size()), resources_.data(), stream.get()),
          "cudaGraphicsMapResources");
    addresses_.resize(resources_.size());
    for (std::size_t i = 0; i < resources_.size(); ++i)
    {
        std::size_t bytes = 0;
        check(calls_.address(&addresses_[i], &bytes, resources_[i]), "cudaGraphicsResourceGetMappedPointer");
    }
}

void RegisteredBuffers::unmap(StreamRef stream)
{
    addresses_.clear();
    check(calls_.unmap(static_cast<int>(resources_.size()), resources_.data(), stream.get()),
          "cudaGraphicsUnmapResources");
}

}  // namespace spindrift::gpu
