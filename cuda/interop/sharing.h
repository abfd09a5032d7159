// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cuda/interop/drawn_memory.h"
#include "cuda/interop/graphics_calls.h"

namespace spindrift::gpu
{

enum class SharingWish
{
    automatic,  ///< share where it works
    on,         ///< share or fail
    off,        ///< copy
};

/// How flakes come from CUDA to the current GL context.
struct Sharing
{
    bool shared = false;
    std::optional<int> device;  ///< on which GL draws, where that is known
    std::string because;        ///< why shared or not, in one line
};

/// Finds the CUDA device of the current GL context, makes it the current one of this thread, and probes
/// whether the two can share memory. Throws Error for SharingWish::on where they cannot.
Sharing find_sharing(SharingWish wish, const GraphicsCalls& calls = {});

/// Memory for flakes that GL draws. If GL's buffers cannot be registered after all, `sharing` says so and the
/// copy takes over (SharingWish::on: throws Error).
std::unique_ptr<DrawnMemory> make_drawn_memory(std::size_t capacity, SharingWish wish, Sharing& sharing,
                                               const GraphicsCalls& calls = {});

/// "GL's buffers, which CUDA writes in place" or "device memory, ...".
std::string describe(const Sharing& sharing);

}  // namespace spindrift::gpu
