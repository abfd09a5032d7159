// SPDX-License-Identifier: MIT
#include "cpu/pack.h"

namespace spindrift::cpu
{
using Real = float;
}

#include "cpu/kernels.inl"

namespace spindrift::cpu
{

const KernelTable kScalarFmaKernels = {advect, list_visible, place_sprites, blend_tile};

}  // namespace spindrift::cpu
