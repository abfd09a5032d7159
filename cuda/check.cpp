// SPDX-License-Identifier: MIT
#include "cuda/check.h"

#include <fmt/format.h>

#include "core/error.h"

namespace spindrift::gpu
{

std::string error_text(cudaError_t code)
{
    return fmt::format("{} ({}, {})", cudaGetErrorName(code), static_cast<int>(code),
                       cudaGetErrorString(code));
}

void throw_call_failed(cudaError_t code, const char* what)
{
    cudaGetLastError();
    throw Error(fmt::format("CUDA: {} failed: {}", what, error_text(code)));
}

void throw_no_room(cudaError_t code, std::size_t bytes)
{
    cudaGetLastError();
    throw Error(fmt::format("CUDA: no room for {:.1f} MiB on the device: {}; ask for fewer particles",
                            static_cast<double>(bytes) / 1048576.0, error_text(code)));
}

void throw_launch_failed(cudaError_t code, const char* name, unsigned blocks, unsigned threads)
{
    cudaGetLastError();
    throw Error(fmt::format("CUDA: launch of {} ({} blocks of {}) failed: {}", name, blocks, threads,
                            error_text(code)));
}

}  // namespace spindrift::gpu
