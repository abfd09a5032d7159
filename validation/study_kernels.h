// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/advect_job.h"
#include "core/flake.h"
#include "validation/study_field.h"

namespace spindrift::validation
{

enum class Rival
{
    explicit_euler,
    bailey,
    exact_ou_sum,
};

/// One period of a wind along x, wrapped: sixteen numbers a cell as integrators.h reads them.
struct RivalField
{
    GridWind grid;
    const float* numbers = nullptr;
};

// All on one thread, one flake at a time, in code for AVX2 with FMA, as cpu::Simd::scalar_fma: what differs
// is the scheme alone. Call them only where that variant is available.

/// u' in q1 … q3. A flake whose velocity is not finite or beyond ten standard deviations is taken out
/// (Fate::vanished); returns how many.
std::size_t step_rival(Rival rival, const RivalField& field, const FlakeView& flakes, std::size_t count,
                       float dt, std::uint64_t seed, std::uint32_t number);

/// The advection of scenes over another field. `numbers`: float, or half as std::uint16_t.
void step_on_grid(const AdvectJob& job, const float* numbers, Sampling sampling, std::size_t count);
void step_on_grid(const AdvectJob& job, const std::uint16_t* numbers, Sampling sampling, std::size_t count);

/// Ours in double, on the float grid: x and q of each flake, 6 numbers; wraps x at 1 m. Of `step`, its
/// seed and relaxations.
void step_in_double(const GridWind& grid, const float* numbers, double* states, const std::uint32_t* ids,
                    std::size_t count, const StepParams& step, double dt, std::uint32_t number);

}  // namespace spindrift::validation
