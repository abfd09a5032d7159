// SPDX-License-Identifier: MIT
#include "cpu/simd.h"

#include <algorithm>

#include <fmt/format.h>

#include "core/error.h"

namespace spindrift::cpu
{

std::vector<Simd> available_simd()
{
    std::vector<Simd> all{Simd::scalar};
    __builtin_cpu_init();
    if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma") && __builtin_cpu_supports("f16c"))
    {
        all.push_back(Simd::scalar_fma);
        all.push_back(Simd::avx2);
        if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512dq") &&
            __builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vl"))
            all.push_back(Simd::avx512);
    }
    return all;
}

std::string simd_name(Simd simd)
{
    switch (simd)
    {
        case Simd::automatic:
            return "automatic";
        case Simd::scalar:
            return "scalar";
        case Simd::scalar_fma:
            return "scalar-fma";
        case Simd::avx2:
            return "avx2";
        case Simd::avx512:
            return "avx512";
    }
    return "unknown";
}

Simd choose_simd(Simd asked)
{
    const std::vector<Simd> all = available_simd();
    if (asked == Simd::automatic) return all.back();
    if (std::find(all.begin(), all.end(), asked) != all.end()) return asked;
    std::string names;
    for (const Simd simd : all) names += (names.empty() ? "" : ", ") + simd_name(simd);
    throw Error(fmt::format("simd = {} cannot run on this processor; it has {}", simd_name(asked), names));
}

const KernelTable& kernels(Simd simd)
{
    switch (simd)
    {
        case Simd::avx512:
            return kAvx512Kernels;
        case Simd::avx2:
            return kAvx2Kernels;
        case Simd::scalar_fma:
            return kScalarFmaKernels;
        default:
            return kScalarKernels;
    }
}

}  // namespace spindrift::cpu
