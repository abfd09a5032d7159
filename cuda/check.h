// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>

#include <cuda_runtime_api.h>

namespace spindrift::gpu
{

/// "cudaErrorMemoryAllocation (2, out of memory)".
std::string error_text(cudaError_t code);

// What throws Error for a code is in check.cpp: nvcc 13 cannot read fmt's checks of format strings. Each
// clears the error where it is not sticky, so that what comes after does not answer for it.
[[noreturn]] void throw_call_failed(cudaError_t code, const char* what);
[[noreturn]] void throw_no_room(cudaError_t code, std::size_t bytes);
[[noreturn]] void throw_launch_failed(cudaError_t code, const char* name, unsigned blocks, unsigned threads);

/// Throws Error with the code that a call returned; `what` names the call.
inline void check(cudaError_t code, const char* what)
{
    if (code != cudaSuccess) throw_call_failed(code, what);
}

}  // namespace spindrift::gpu
