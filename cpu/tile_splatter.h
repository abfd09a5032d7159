// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "core/splatter.h"
#include "cpu/cpu_backend.h"

namespace spindrift::cpu
{

/// Blends in tiles of the picture, each on one thread, by the kernels of an instruction set. The result does
/// not depend on threads or instruction set. Throws Error if the asked variant cannot run here.
std::unique_ptr<Splatter> make_tile_splatter(const CpuOptions& options);

}  // namespace spindrift::cpu
