// SPDX-License-Identifier: MIT
#pragma once

#include "cpu/cpu_backend.h"
#include "cpu/kernels.h"

namespace spindrift::cpu
{

/// The variant to run: the widest one if `asked` is automatic. Throws Error if this processor cannot run it.
Simd choose_simd(Simd asked);

/// The kernels of a variant that choose_simd gave.
const KernelTable& kernels(Simd simd);

}  // namespace spindrift::cpu
