// SPDX-License-Identifier: MIT
#include "cpu/pack.h"

namespace spindrift::cpu
{
using Real = Avx512Real;
}

#include "cpu/kernels.inl"

namespace spindrift::cpu
{

const KernelTable kAvx512Kernels = {advect, list_visible, place_sprites, blend_tile};

}  // namespace spindrift::cpu
