// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "cuda/buffer.h"
#include "cuda/stream.h"

namespace spindrift::bench
{

/// The floor on a device: a plain copy in its memory.
class DeviceCopy
{
  public:
    explicit DeviceCopy(std::size_t bytes) : from_(bytes), to_(bytes) {}

    /// Milliseconds of one copy, which reads and writes so many bytes.
    double ms()
    {
        start_.record(stream_);
        gpu::check(cudaMemcpyAsync(to_.data(), from_.data(), from_.bytes(), cudaMemcpyDeviceToDevice,
                                   stream_.ref().get()),
                   "cudaMemcpyAsync");
        end_.record(stream_);
        end_.wait();
        return end_.ms_since(start_);
    }

  private:
    gpu::DeviceBuffer<unsigned char> from_, to_;
    gpu::Stream stream_;
    gpu::Event start_{gpu::Event::Timing::on}, end_{gpu::Event::Timing::on};
};

}  // namespace spindrift::bench
