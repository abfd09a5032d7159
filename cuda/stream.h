// SPDX-License-Identifier: MIT
#pragma once

#include <utility>

#include <cuda_runtime_api.h>

#include "cuda/check.h"

namespace spindrift::gpu
{

/// A stream that somebody else owns. Everything in cuda/ that queues work takes one.
class StreamRef
{
  public:
    explicit StreamRef(cudaStream_t stream) : stream_(stream) {}
    cudaStream_t get() const { return stream_; }
    void wait() const { check(cudaStreamSynchronize(stream_), "cudaStreamSynchronize"); }

  private:
    cudaStream_t stream_;
};

/// Owns a stream that does not wait for the legacy default stream. It must be idle or its work unneeded when
/// it is destroyed.
class Stream
{
  public:
    Stream() { check(cudaStreamCreateWithFlags(&stream_, cudaStreamNonBlocking), "cudaStreamCreate"); }
    ~Stream()
    {
        if (stream_ != nullptr) cudaStreamDestroy(stream_);
    }
    Stream(Stream&& other) noexcept : stream_(std::exchange(other.stream_, nullptr)) {}
    Stream& operator=(Stream&& other) noexcept
    {
        std::swap(stream_, other.stream_);
        return *this;
    }
    StreamRef ref() const { return StreamRef(stream_); }
    operator StreamRef() const { return ref(); }

  private:
    cudaStream_t stream_ = nullptr;
};

/// Owns an event: a mark in a stream that others, or the host, can wait for.
class Event
{
  public:
    enum class Timing
    {
        off,
        on,
    };

    explicit Event(Timing timing = Timing::off)
    {
        check(cudaEventCreateWithFlags(&event_,
                                       timing == Timing::on ? cudaEventDefault : cudaEventDisableTiming),
              "cudaEventCreate");
    }
    ~Event()
    {
        if (event_ != nullptr) cudaEventDestroy(event_);
    }
    Event(Event&& other) noexcept : event_(std::exchange(other.event_, nullptr)) {}
    Event& operator=(Event&& other) noexcept
    {
        std::swap(event_, other.event_);
        return *this;
    }

    void record(StreamRef stream) { check(cudaEventRecord(event_, stream.get()), "cudaEventRecord"); }
    void wait() const { check(cudaEventSynchronize(event_), "cudaEventSynchronize"); }
    /// Whether everything before the mark is done; never waits. True if nothing was recorded.
    bool is_done() const
    {
        const cudaError_t code = cudaEventQuery(event_);
        if (code == cudaErrorNotReady) return false;
        check(code, "cudaEventQuery");
        return true;
    }
    /// Milliseconds from `start` to this one; both recorded with Timing::on and done.
    double ms_since(const Event& start) const
    {
        float ms = 0;
        check(cudaEventElapsedTime(&ms, start.event_, event_), "cudaEventElapsedTime");
        return static_cast<double>(ms);
    }

  private:
    cudaEvent_t event_ = nullptr;
};

}  // namespace spindrift::gpu
