// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "core/platform.h"

namespace spindrift
{

/// Sorting networks whose comparators all put the smaller element at the lower index (docs/sorting.md). So no
/// step ever adds an inversion, what is sorted stays sorted, and elements past the end need not exist: they
/// would be larger than all others and never move.
enum class Network
{
    bitonic,   ///< stages that merge sorted blocks into ones of twice the size; exact after the last stage
    odd_even,  ///< neighbours, by turns (0,1)(2,3)… and (1,2)(3,4)…; exact after n steps
};

/// Comparators that touch no element twice, so that all may run at once. Comparator c puts the elements
/// upper(c) and lower(upper(c)) in order; there are comparators(n) of them for n elements. Counted from
/// `offset`, the two lie in the upper and lower half of one block of 2 * half elements.
struct NetworkStep
{
    std::uint32_t mask;    ///< lower = upper ^ mask: half, or 2 * half - 1 for the mirrored element
    std::uint32_t half;    ///< the highest bit of mask
    std::uint32_t offset;  ///< 0 or 1

    SPINDRIFT_HD std::size_t upper(std::size_t c) const
    {
        const std::size_t within = std::size_t{half} - 1;
        return offset + (((c & ~within) << 1) | half | (c & within));
    }
    SPINDRIFT_HD std::size_t lower(std::size_t upper) const { return ((upper - offset) ^ mask) + offset; }
    SPINDRIFT_HD std::size_t comparators(std::size_t n) const
    {
        if (n <= offset) return 0;
        const std::size_t block = 2 * std::size_t{half};
        const std::size_t rest = (n - offset) % block;
        return (n - offset) / block * half + (rest > half ? rest - half : 0);
    }
    /// Whether no comparator leaves the aligned tile of `tile` elements (a power of two) that it begins in.
    SPINDRIFT_HD bool stays_in_tiles_of(std::size_t tile) const
    {
        return offset == 0 && 2 * std::size_t{half} <= tile;
    }
};

/// Stages of the bitonic network for n elements; stage s has s steps.
inline int bitonic_stages(std::size_t n)
{
    return n < 2 ? 0 : static_cast<int>(std::bit_width(n - 1));
}
/// Steps after which n elements are sorted, whatever they are.
inline std::size_t network_steps(Network network, std::size_t n)
{
    const auto stages = static_cast<std::size_t>(bitonic_stages(n));
    return network == Network::bitonic ? stages * (stages + 1) / 2 : n;
}

/// Elements that fit near the processor (32 KiB of pairs): steps that stay in aligned tiles of so many run
/// together, on every backend.
inline constexpr std::size_t kNetworkTile = 4096;

/// How often the whole bitonic network moves all n elements when steps that stay in tiles run together.
inline std::size_t bitonic_sweeps(std::size_t n)
{
    if (n < 2) return 0;
    const int beyond = bitonic_stages(n) - bitonic_stages(kNetworkTile);
    const auto b = static_cast<std::size_t>(beyond > 0 ? beyond : 0);
    return 1 + b * (b + 3) / 2;  // a stage that goes b doublings beyond a tile: b steps, and the tiles once
}

/// The steps of a network one after the other, round and round; the number of elements may change between
/// two steps, as the number of visible flakes does between two frames.
class NetworkWalk
{
  public:
    explicit NetworkWalk(Network network) : network_(network) {}

    /// The next step for n elements; n >= 2.
    NetworkStep next(std::size_t n)
    {
        if (network_ == Network::odd_even)
        {
            const NetworkStep step{.mask = 1, .half = 1, .offset = step_};
            step_ ^= 1U;
            return step;
        }
        if (stage_ > static_cast<std::uint32_t>(bitonic_stages(n))) stage_ = 1, step_ = 0;
        const std::uint32_t half = 1U << (stage_ - 1 - step_);
        const NetworkStep step{.mask = step_ == 0 ? 2 * half - 1 : half, .half = half, .offset = 0};
        if (++step_ == stage_) ++stage_, step_ = 0;
        return step;
    }

  private:
    Network network_;
    std::uint32_t stage_ = 1;  ///< of the next step: it makes sorted blocks of 2^stage elements
    std::uint32_t step_ = 0;   ///< of the stage; of odd_even: 0 or 1
};

}  // namespace spindrift
