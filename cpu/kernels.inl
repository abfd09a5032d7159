// SPDX-License-Identifier: MIT
// The bodies of a KernelTable over the number type Real, which the translation unit that includes this names.

#include "core/advect.h"
#include "core/visible.h"
#include "cpu/kernels.h"
#include "cpu/pack_grid.h"

namespace spindrift::cpu
{

namespace
{

constexpr std::size_t kWidth = NumberTraits<Real>::width;

// The packs' own would hide them from scalars.
using spindrift::as_uint;
using spindrift::gather;
using spindrift::gather_bytes;

/// So many flakes ahead of the ones that move, the wind cells round them are called into the second-level
/// cache: straight into the first they stop up its few miss buffers.
constexpr std::size_t kPrefetchFlakes = 64;

/// Calls the cells round the pack at `at`, in four quarters: all at once they wait for miss buffers longer
/// than the processor can look past them, so that nothing is computed meanwhile
/// (docs/decisions/008-cells-fetched-in-quarters.md).
template <class WindField>
struct CellsAhead : NothingMeanwhile
{
    SPINDRIFT_HD CellsAhead(const WindField&, const FlakeView&, std::size_t) {}
};

template <>
struct CellsAhead<GridWind>
{
    const GridWind& grid;
    std::int32_t index[kWidth];

    SPINDRIFT_HD CellsAhead(const GridWind& g, const FlakeView& f, std::size_t at) : grid(g)
    {
        store(index,
              g.locate(Vec3<Real>{load<Real>(f.x + at), load<Real>(f.y + at), load<Real>(f.z + at)}).index);
    }
    /// A flake has four rows of two cells.
    SPINDRIFT_HD void quarter(int number) const
    {
        constexpr int rows = static_cast<int>(kWidth);
        for (int row = number * rows; row < (number + 1) * rows; ++row)
        {
            const WindCell* cells =
                grid.cells + index[row / 4] + (row & 1 ? grid.step_y : 0) + (row & 2 ? grid.step_z : 0);
            __builtin_prefetch(cells, 0, 2);
            __builtin_prefetch(cells + grid.step_x, 0, 2);
        }
    }
};

/// The rare flakes that meet something, out of the way of the others: inlined, their code pushed the pack
/// loop out of the instruction cache. Its type is local to this translation unit, so nothing of it is shared.
struct OutOfLineResolver
{
    EncounterResolver resolve;

    OutOfLineResolver(const Surroundings& around, std::uint64_t seed, std::uint32_t step,
                      std::uint32_t substep, bool turbulent, bool inertial)
        : resolve{around, seed, step, substep, turbulent, inertial}
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
        const std::size_t ahead = i + kPrefetchFlakes + kWidth <= last ? i + kPrefetchFlakes : i;
        advector(i, tally, CellsAhead<WindField>(wind, job.flakes, ahead));
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
SPINDRIFT_HD std::size_t list_pack(const VisibleFlakes<R>& flakes, std::size_t i, std::uint64_t* out)
{
    constexpr int width = NumberTraits<R>::width;
    const Vec3<R> d = flakes.offset(i);
    const std::uint32_t visible = mask_bits(flakes.sees(i, d));
    if (visible == 0) return 0;
    std::uint32_t keys[width];
    store(keys, flakes.key(d));
    std::size_t n = 0;
    for (int l = 0; l < width; ++l)
    {
        out[n] = draw_list_pair(keys[l], i + static_cast<std::size_t>(l));
        n += visible >> l & 1U;
    }
    return n;
}

std::size_t list_visible(const Frustum& frustum, const FlakeView& flakes, std::size_t first, std::size_t last,
                         std::uint64_t* out)
{
    std::uint64_t* to = out;
    std::size_t i = first;
    for (; i + kWidth <= last; i += kWidth) to += list_pack(VisibleFlakes<Real>{frustum, flakes}, i, to);
    for (; i < last; ++i) to += list_pack(VisibleFlakes<float>{frustum, flakes}, i, to);
    return static_cast<std::size_t>(to - out);
}

}  // namespace

}  // namespace spindrift::cpu

#include "cpu/blend_tile.inl"
#include "cpu/place_sprites.inl"
