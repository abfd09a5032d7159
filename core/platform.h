// SPDX-License-Identifier: MIT
#pragma once

/// Marks a function of core/ that runs on the host and, under nvcc, on the device too.
/// It is always inlined: the kernels of cpu/ are compiled once per instruction set, and a shared
/// out-of-line copy would let the linker hand AVX-512 code to a machine without it.
#if defined(__CUDACC__)
#define SPINDRIFT_HD __host__ __device__ __forceinline__
#else
#define SPINDRIFT_HD inline __attribute__((always_inline))
#endif
