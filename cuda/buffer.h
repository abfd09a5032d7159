// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include <cuda_runtime_api.h>

#include "cuda/check.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// Waits for what stands in the legacy default stream, since Stream does not. A fill is not done when the
/// call that queued it returns, nor is a copy from memory that is not page-locked.
inline void wait_for_default_stream()
{
    check(cudaStreamSynchronize(nullptr), "cudaStreamSynchronize");
}

/// Copies from any host memory and waits until the bytes are there.
template <class T>
void copy_to_device_now(T* device, const T* host, std::size_t count)
{
    if (count == 0) return;
    check(cudaMemcpy(device, host, count * sizeof(T), cudaMemcpyHostToDevice), "cudaMemcpy to the device");
    wait_for_default_stream();
}

/// Owns device memory for `size` elements; its contents are undefined at first. Throws Error, with the size,
/// if the device has not got it. Allocate at start, never in a step.
template <class T>
class DeviceBuffer
{
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    DeviceBuffer() = default;
    explicit DeviceBuffer(std::size_t size) : size_(size)
    {
        if (size == 0) return;
        const cudaError_t code = cudaMalloc(reinterpret_cast<void**>(&data_), size * sizeof(T));
        if (code != cudaSuccess) throw_no_room(code, size * sizeof(T));
    }
    /// Waits until the copy is made.
    explicit DeviceBuffer(const std::vector<T>& from) : DeviceBuffer(from.size())
    {
        copy_to_device_now(data_, from.data(), size_);
    }
    ~DeviceBuffer() { cudaFree(data_); }
    DeviceBuffer(DeviceBuffer&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0))
    {
    }
    DeviceBuffer& operator=(DeviceBuffer&& other) noexcept
    {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }

    /// Gives every byte this value and waits until they have it.
    void fill_now(int byte)
    {
        if (size_ == 0) return;
        check(cudaMemset(data_, byte, bytes()), "cudaMemset");
        wait_for_default_stream();
    }

    T* data() const { return data_; }  ///< device address
    std::size_t size() const { return size_; }
    std::size_t bytes() const { return size_ * sizeof(T); }

  private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

/// Owns page-locked host memory that the device copies to and from without a stop.
template <class T>
class PinnedBuffer
{
    static_assert(std::is_trivially_copyable_v<T>);

  public:
    PinnedBuffer() = default;
    explicit PinnedBuffer(std::size_t size) : size_(size)
    {
        if (size > 0)
            check(cudaMallocHost(reinterpret_cast<void**>(&data_), size * sizeof(T)), "cudaMallocHost");
    }
    ~PinnedBuffer() { cudaFreeHost(data_); }
    PinnedBuffer(PinnedBuffer&& other) noexcept
        : data_(std::exchange(other.data_, nullptr)), size_(std::exchange(other.size_, 0))
    {
    }
    PinnedBuffer& operator=(PinnedBuffer&& other) noexcept
    {
        std::swap(data_, other.data_);
        std::swap(size_, other.size_);
        return *this;
    }

    T* data() const { return data_; }
    std::size_t size() const { return size_; }
    T& operator[](std::size_t i) const { return data_[i]; }

  private:
    T* data_ = nullptr;
    std::size_t size_ = 0;
};

/// Queues a copy of `count` elements; the host side must be pinned and stay until the stream is past it.
template <class T>
void copy_to_device(StreamRef stream, T* device, const T* host, std::size_t count)
{
    check(cudaMemcpyAsync(device, host, count * sizeof(T), cudaMemcpyHostToDevice, stream.get()),
          "cudaMemcpyAsync to the device");
}
template <class T>
void copy_to_host(StreamRef stream, T* host, const T* device, std::size_t count)
{
    check(cudaMemcpyAsync(host, device, count * sizeof(T), cudaMemcpyDeviceToHost, stream.get()),
          "cudaMemcpyAsync to the host");
}

}  // namespace spindrift::gpu
