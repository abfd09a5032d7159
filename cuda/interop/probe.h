// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/platform.h"
#include "cuda/interop/graphics_calls.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

inline constexpr std::size_t kProbeWords = 1024;

/// Whether kernels can change a GL buffer and GL reads what they wrote, tried once on a small one:
/// registered, mapped, changed, unmapped, read by GL, compared. Empty: it works; otherwise what failed, in
/// one line. Never throws; leaves neither a CUDA nor a GL error behind. On the current CUDA device.
std::string probe_interop(const GraphicsCalls& calls = {});

/// What GL puts into word i, and what the kernel makes of it: no word can pass that one of them did not
/// write.
SPINDRIFT_HD constexpr std::uint32_t probe_seed(std::uint32_t i)
{
    return i * 0x9E3779B9U + 0x7F4A7C15U;
}
SPINDRIFT_HD constexpr std::uint32_t probe_answer(std::uint32_t seed, std::uint32_t i)
{
    return (seed ^ 0xA5A5A5A5U) * 0x85EBCA6BU + i;
}

/// Queues the kernel, over kProbeWords words.
void answer_probe(StreamRef stream, std::uint32_t* words);

}  // namespace spindrift::gpu
