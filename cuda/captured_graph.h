// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <cuda_runtime_api.h>

#include "cuda/check.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// Work that was recorded once and is queued as a whole ever after. Addresses and sizes in it are those of
/// the recording.
class CapturedGraph
{
  public:
    /// Records what `queue()` queues on the stream; nothing of it runs. Throws what it throws.
    template <class Queue>
    CapturedGraph(StreamRef stream, const Queue& queue)
    {
        check(cudaStreamBeginCapture(stream.get(), cudaStreamCaptureModeThreadLocal),
              "cudaStreamBeginCapture");
        cudaGraph_t graph = nullptr;
        try
        {
            queue();
        }
        catch (...)
        {
            cudaStreamEndCapture(stream.get(), &graph);
            cudaGraphDestroy(graph);
            cudaGetLastError();
            throw;
        }
        check(cudaStreamEndCapture(stream.get(), &graph), "cudaStreamEndCapture");
        const cudaError_t code = cudaGraphInstantiate(&work_, graph, 0);
        cudaGraphDestroy(graph);
        check(code, "cudaGraphInstantiate");
    }
    ~CapturedGraph()
    {
        if (work_ != nullptr) cudaGraphExecDestroy(work_);
    }
    CapturedGraph(CapturedGraph&& other) noexcept : work_(std::exchange(other.work_, nullptr)) {}
    CapturedGraph& operator=(CapturedGraph&& other) noexcept
    {
        std::swap(work_, other.work_);
        return *this;
    }

    void launch(StreamRef stream) const { check(cudaGraphLaunch(work_, stream.get()), "cudaGraphLaunch"); }

  private:
    cudaGraphExec_t work_ = nullptr;
};

}  // namespace spindrift::gpu
