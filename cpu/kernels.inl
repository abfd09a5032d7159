// SPDX-License-Identifier: MIT
// The bodies of a KernelTable over the number type Real, which the translation unit that includes this names.

#include "core/advect.h"
#include "cpu/kernels.h"
#include "cpu/pack_grid.h"

namespace spindrift::cpu
{

namespace
{

constexpr std::size_t kWidth = NumberTraits<Real>::width;

// The packs' own would hide them from scalars.
using spindrift::gather;
using spindrift::gather_bytes;

/// So many flakes ahead of the ones that move, the wind cells round them are called into the second-level
/// cache: straight into the first they stop up its few miss buffers, which took half as long again
/// (docs/benchmarking.md, advection).
constexpr std::size_t kPrefetchFlakes = 64;

template <class WindField>
SPINDRIFT_HD void prefetch(const WindField&, const FlakeView&, std::size_t, std::size_t)
{
}

SPINDRIFT_HD void prefetch(const GridWind& grid, const FlakeView& flakes, std::size_t first, std::size_t last)
{
    if (first + kWidth > last) return;
    const GridPoint<Real> p = grid.locate(
        Vec3<Real>{load<Real>(flakes.x + first), load<Real>(flakes.y + first), load<Real>(flakes.z + first)});
    std::int32_t index[kWidth];
    store(index, p.index);
    for (std::size_t l = 0; l < kWidth; ++l)
        for (int corner = 0; corner < 4; ++corner)
        {
            const WindCell* row =
                grid.cells + index[l] + (corner & 1 ? grid.step_y : 0) + (corner & 2 ? grid.step_z : 0);
            __builtin_prefetch(row, 0, 2);
            __builtin_prefetch(row + grid.step_x, 0, 2);
        }
}

/// The rare flakes that meet something, out of the way of the others: inlined, their code pushed the pack
/// loop out of the instruction cache. Its type is local to this translation unit, so nothing of it is shared.
struct OutOfLineResolver
{
    EncounterResolver resolve;

    OutOfLineResolver(const Surroundings& around, std::uint64_t seed, std::uint32_t step,
                      std::uint32_t substep, bool turbulent)
        : resolve{around, seed, step, substep, turbulent}
    {
    }
    __attribute__((noinline, cold)) void operator()(Encounter& f, EncounterTally& tally) const
    {
        resolve(f, tally);
    }
};

template <class WindField, bool Turbulent>
SPINDRIFT_HD void advect_in(const WindField& wind, const AdvectJob& job, std::size_t first, std::size_t last,
                            EncounterTally& tally)
{
    const FlakeAdvector<Real, WindField, Turbulent, OutOfLineResolver> advector{
        job.step, wind, job.fall_speed, job.around, job.flakes};
    std::size_t i = first;
    for (; i + kWidth <= last; i += kWidth)
    {
        prefetch(wind, job.flakes, i + kPrefetchFlakes, last);
        advector(i, tally);
    }
    // fewer than a pack: the scalar kernels give the same bits, and need no second copy of the advector here
    if constexpr (kWidth > 1)
        if (i < last) kScalarKernels.advect(job, i, last, tally);
}

template <class WindField>
SPINDRIFT_HD void advect_in(const WindField& wind, const AdvectJob& job, std::size_t first, std::size_t last,
                            EncounterTally& tally)
{
    if (job.turbulent)
        advect_in<WindField, true>(wind, job, first, last, tally);
    else
        advect_in<WindField, false>(wind, job, first, last, tally);
}

void advect(const AdvectJob& job, std::size_t first, std::size_t last, EncounterTally& tally)
{
    switch (job.wind_kind)
    {
        case WindKind::uniform:
            advect_in(job.uniform, job, first, last, tally);
            break;
        case WindKind::logarithmic:
            advect_in(job.logarithmic, job, first, last, tally);
            break;
        case WindKind::grid:
            advect_in(job.grid, job, first, last, tally);
            break;
    }
}

/// One pack of the draw list; returns how many pairs it wrote.
template <class R>
SPINDRIFT_HD std::size_t list_pack(const Frustum& frustum, const FlakeView& flakes, std::size_t i,
                                   std::uint64_t* out)
{
    constexpr int width = NumberTraits<R>::width;
    using UInt = UIntOf<R>;
    const Vec3<R> x{load<R>(flakes.x + i), load<R>(flakes.y + i), load<R>(flakes.z + i)};
    const Vec3<R> d = from_eye(frustum, x);
    const auto alive = (load<UInt>(flakes.state + i) & UInt(0xFFU)) == UInt(0U);
    const std::uint32_t visible = mask_bits(alive && in_view(frustum, d));
    if (visible == 0) return 0;
    std::uint32_t keys[width];
    store(keys, depth_key(frustum, d));
    std::size_t n = 0;
    for (int l = 0; l < width; ++l)
    {
        out[n] = static_cast<std::uint64_t>(keys[l]) << 32 | (i + static_cast<std::size_t>(l));
        n += visible >> l & 1U;
    }
    return n;
}

std::size_t list_visible(const Frustum& frustum, const FlakeView& flakes, std::size_t first, std::size_t last,
                         std::uint64_t* out)
{
    std::uint64_t* to = out;
    std::size_t i = first;
    for (; i + kWidth <= last; i += kWidth) to += list_pack<Real>(frustum, flakes, i, to);
    for (; i < last; ++i) to += list_pack<float>(frustum, flakes, i, to);
    return static_cast<std::size_t>(to - out);
}

}  // namespace

}  // namespace spindrift::cpu

#include "cpu/blend_tile.inl"
#include "cpu/place_sprites.inl"
