// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "cuda/interop/graphics_calls.h"
#include "gl/context.h"

namespace spindrift::gpu
{

/// The CUDA device on which the current GL context draws.
struct GlDevice
{
    std::optional<int> ordinal;  ///< none: they are not on one device, or cannot say so
    std::string because;         ///< why none, in one line; or who named it
};

/// Asks CUDA, and under EGL also the EGL device: CUDA_VISIBLE_DEVICES renumbers one but not the other. Never
/// throws; leaves no error behind.
GlDevice device_of_context(const GraphicsCalls& calls = {});

/// A headless GL context on a GPU that CUDA has, where EGL offers one; otherwise as
/// gl::make_headless_context().
std::unique_ptr<gl::Context> make_context_beside_cuda();

}  // namespace spindrift::gpu
