// SPDX-License-Identifier: MIT
#include "cuda/rearrange.h"

#include <algorithm>
#include <array>

#include <cub/device/device_radix_sort.cuh>

#include "core/flake_words.h"
#include "core/kept_order.h"
#include "cuda/launch.cuh"
#include "cuda/selection.cuh"

namespace spindrift::gpu
{

namespace
{

constexpr unsigned kAtOnce = 3;

/// The four arrays of a word a flake that the draw list's memory makes.
std::array<std::uint32_t*, 4> quarters(const DrawListView& list, std::size_t capacity)
{
    auto* const pairs = reinterpret_cast<std::uint32_t*>(list.pairs);
    auto* const scratch = reinterpret_cast<std::uint32_t*>(list.scratch);
    return {pairs, pairs + capacity, scratch, scratch + capacity};
}

struct Alive
{
    const std::uint32_t* state;
    __device__ bool operator()(std::size_t i) const { return is_alive(state[i]); }
};

struct NoteSource
{
    std::uint32_t* sources;
    __device__ void operator()(std::size_t i, std::uint32_t rank) const
    {
        sources[rank] = static_cast<std::uint32_t>(i);
    }
};

struct Words
{
    std::uint32_t* at[kAtOnce];
    unsigned count;
};

/// to.at[a][i] = from.at[a][source]; unrolled, so that the addresses stay where the kernel's arguments are.
__device__ void copy_words(const Words& from, std::size_t source, const Words& to, std::size_t i)
{
#pragma unroll
    for (unsigned a = 0; a < kAtOnce; ++a)
        if (a < from.count) to.at[a][i] = from.at[a][source];
}

struct Gather
{
    const std::uint32_t* sources;
    Words from, to;
    __device__ void operator()(std::size_t i) const { copy_words(from, sources[i], to, i); }
};

struct PutBack
{
    Words from, to;
    __device__ void operator()(std::size_t i) const { copy_words(from, i, to, i); }
};

struct ClearFreeRanks
{
    const StepControl* control;
    std::uint32_t* ranks;
    __device__ void operator()(std::size_t i) const
    {
        if (i >= control->kept) ranks[i] = kNoRank;
    }
};

/// Slot i becomes what slot sources[i] was, for i < StepControl::kept.
void move_flakes(StreamRef stream, const StepControl* control, std::size_t capacity, const FlakeView& flakes,
                 std::uint32_t* ranks, const std::uint32_t* sources,
                 const std::array<std::uint32_t*, kAtOnce>& by_way_of)
{
    std::array<std::uint32_t*, kFlakeArrays + 1> arrays{};
    std::ranges::copy(flake_words(flakes), arrays.begin());
    arrays.back() = ranks;
    const std::size_t count = arrays.size() - (ranks == nullptr ? 1 : 0);
    for (std::size_t first = 0; first < count; first += kAtOnce)
    {
        Words home{}, away{};
        for (std::size_t a = first; a < count && home.count < kAtOnce; ++a)
        {
            away.at[away.count++] = by_way_of[home.count];
            home.at[home.count++] = arrays[a];
        }
        launch_counted(stream, "gather flakes", &control->kept, capacity, Gather{sources, home, away});
        launch_counted(stream, "put back flakes", &control->kept, capacity, PutBack{away, home});
    }
    if (ranks != nullptr)
        launch_counted(stream, "clear free ranks", &control->closing, capacity,
                       ClearFreeRanks{control, ranks});
}

/// Keys of all slots; those that are not in use come last, as holes do.
struct MakeKeys
{
    const StepControl* control;
    CellOrder order;
    std::uint32_t *keys, *slots;
    __device__ void operator()(std::size_t i) const
    {
        keys[i] = i < control->closing ? order(i) : order.cells();
        slots[i] = static_cast<std::uint32_t>(i);
    }
};

cudaError_t sort_slots(void* memory, std::size_t& bytes, cub::DoubleBuffer<std::uint32_t>& keys,
                       cub::DoubleBuffer<std::uint32_t>& slots, std::size_t n, int key_bits,
                       cudaStream_t stream)
{
    return cub::DeviceRadixSort::SortPairs(memory, bytes, keys, slots, static_cast<std::uint32_t>(n), 0,
                                           key_bits, stream);
}

std::size_t sort_bytes(std::size_t capacity, int key_bits)
{
    std::size_t bytes = 0;
    cub::DoubleBuffer<std::uint32_t> keys, slots;
    check(sort_slots(nullptr, bytes, keys, slots, capacity, key_bits, nullptr), "cub::DeviceRadixSort");
    return bytes;
}

}  // namespace

Rearranger::Rearranger(std::size_t capacity, Reorders reorders, int key_bits)
    : capacity_(capacity),
      key_bits_(key_bits),
      total_(1),
      sort_(reorders == Reorders::yes && capacity > 0 ? sort_bytes(capacity, key_bits) : 0)
{
}

void Rearranger::close_holes(StreamRef stream, const StepControl* control, const FlakeAddresses& at,
                             const Selection& selection, std::uint32_t* ranks) const
{
    const auto quarter = quarters(at.draw_list, capacity_);
    select(stream, "list living flakes", &control->closing, capacity_, selection, total_.data(),
           Alive{at.flakes.state}, NoteSource{quarter[0]});
    move_flakes(stream, control, capacity_, at.flakes, ranks, quarter[0],
                {quarter[1], quarter[2], quarter[3]});
}

void Rearranger::reorder(StreamRef stream, const StepControl* control, const FlakeAddresses& at,
                         const CellOrder& order, std::uint32_t* ranks) const
{
    if (capacity_ == 0) return;
    const auto quarter = quarters(at.draw_list, capacity_);
    launch(stream, "cell keys", capacity_, MakeKeys{control, order, quarter[0], quarter[1]});
    cub::DoubleBuffer<std::uint32_t> keys(quarter[0], quarter[2]);
    cub::DoubleBuffer<std::uint32_t> slots(quarter[1], quarter[3]);
    std::size_t bytes = sort_.size();
    check(sort_slots(sort_.data(), bytes, keys, slots, capacity_, key_bits_, stream.get()),
          "cub::DeviceRadixSort");
    move_flakes(stream, control, capacity_, at.flakes, ranks, slots.Current(),
                {slots.Alternate(), keys.Current(), keys.Alternate()});
}

}  // namespace spindrift::gpu
