// SPDX-License-Identifier: MIT
#include "cuda/flake_memory.h"

namespace spindrift::gpu
{

namespace
{

constexpr std::size_t kArrays = 11;
constexpr std::size_t kLineWords = 16;  // FlakeView wants arrays aligned to 64 bytes

std::size_t whole_lines(std::size_t words)
{
    return (words + kLineWords - 1) / kLineWords * kLineWords;
}

}  // namespace

DeviceFlakes::DeviceFlakes(std::size_t capacity)
    : capacity_(capacity), stride_(whole_lines(capacity)), words_(kArrays * stride_), pairs_(2 * stride_)
{
    // Whoever reads a slot that nobody wrote must not meet a NaN.
    words_.fill_now(0);
    pairs_.fill_now(0);
}

FlakeAddresses DeviceFlakes::map(StreamRef)
{
    const auto words = [&](std::size_t array) { return words_.data() + array * stride_; };
    const auto floats = [&](std::size_t array) { return reinterpret_cast<float*>(words(array)); };
    return {{floats(0), floats(1), floats(2), floats(3), floats(4), floats(5), floats(6), floats(7),
             floats(8), words(9), words(10)},
            {pairs_.data(), pairs_.data() + stride_}};
}

void DeviceFlakes::hand_over(StreamRef, std::size_t, const DrawList&)
{
    // nobody draws from it
}

void DeviceFlakes::unmap(StreamRef)
{
    // the addresses hold as long as the buffers
}

}  // namespace spindrift::gpu
