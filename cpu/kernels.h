// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/advect_job.h"
#include "core/depth_key.h"
#include "core/encounter.h"
#include "core/flake.h"

namespace spindrift::cpu
{

/// The kernels compiled for one instruction set. Each works on the slots [first, last) on one thread; `first`
/// is a multiple of 16. The translation units behind it include neither threads nor containers, so that no
/// function of theirs that the rest of the program shares is ever compiled for a processor that is not there.
struct KernelTable
{
    void (*advect)(const AdvectJob& job, std::size_t first, std::size_t last, EncounterTally& tally);

    /// Writes key << 32 | slot of the visible flakes to `out` (room for last - first), in slot order; returns
    /// how many.
    std::size_t (*list_visible)(const Frustum& frustum, const FlakeView& flakes, std::size_t first,
                                std::size_t last, std::uint64_t* out);
};

extern const KernelTable kScalarKernels;
extern const KernelTable kScalarFmaKernels;
extern const KernelTable kAvx2Kernels;
extern const KernelTable kAvx512Kernels;

}  // namespace spindrift::cpu
