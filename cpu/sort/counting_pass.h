// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace spindrift::cpu
{

/// Bits [shift, shift + bits) of a pair.
struct Digit
{
    int shift;
    int bits;

    std::size_t values() const { return std::size_t{1} << bits; }
    std::uint64_t mask() const { return (std::uint64_t{1} << bits) - 1; }
    std::uint64_t of(std::uint64_t pair) const { return (pair >> shift) & mask(); }
};

struct ChunkLimits
{
    std::size_t shortest;    ///< pairs, unless there are fewer in all
    std::size_t per_thread;  ///< most for each thread: more than one lets a fast core help a slow one
    std::size_t most;        ///< in all, at most 64
};

/// n pairs cut into equal runs, as many for each thread of the current TBB arena, or fewer runs than threads
/// if they would be short.
class Chunks
{
  public:
    Chunks(std::size_t n, const ChunkLimits& limits);

    std::size_t count() const { return count_; }
    std::size_t begin(std::size_t chunk) const { return n_ / count_ * chunk + n_ % count_ * chunk / count_; }
    std::size_t end(std::size_t chunk) const { return begin(chunk + 1); }

  private:
    std::size_t n_;
    std::size_t count_;
};

/// The bits in which the pairs differ at all; n > 0.
std::uint64_t differing_bits(const std::uint64_t* pairs, const Chunks& chunks);

/// The stable move of pairs into the order of one digit, in three parallel steps over the same chunks.
/// `histograms` holds chunks.count() times digit.values() counters, one histogram after the other. n < 2^32.
/// The outcome does not depend on the number of chunks.

/// Counts the digit's values chunk by chunk.
void count_digit(const std::uint64_t* pairs, const Chunks& chunks, Digit digit, std::uint32_t* histograms);

/// Turns counts into the place of the next pair of each value and chunk.
void counts_to_places(const Chunks& chunks, Digit digit, std::uint32_t* histograms);

/// Moves every pair to its place; uses up the places.
void scatter_by_digit(const std::uint64_t* from, std::uint64_t* to, const Chunks& chunks, Digit digit,
                      std::uint32_t* places);

}  // namespace spindrift::cpu
