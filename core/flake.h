// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

namespace spindrift
{

/// What has become of a flake; the low byte of FlakeView::state. Slots that are not `alive` are holes
/// until the next compaction.
enum class Fate : std::uint32_t
{
    alive = 0,
    left = 1,      ///< crossed the border of the domain
    landed = 2,    ///< came to rest on a surface
    vanished = 3,  ///< ended on a surface that swallows flakes
};

/// The moving flakes as a structure of arrays over memory that somebody else owns (GL, the device or the
/// host). Every array holds `capacity` elements and is aligned to 64 bytes. Slots [0, used) hold flakes, in
/// ascending order of emission unless they are re-ordered by cell; slots whose fate is not `alive` are
/// skipped. Positions are metres in the local frame, whose origin is the lower corner of the domain, z up.
struct FlakeView
{
    float* x;
    float* y;
    float* z;
    float* q1;  ///< whitened turbulent velocity, dimensionless: u' = S(x) q
    float* q2;
    float* q3;
    float* slip_x;  ///< velocity in excess of air + settling, m/s; decays by drag. With inertia: velocity
    float* slip_y;
    float* slip_z;
    std::uint32_t* id;     ///< serial number of emission, modulo 2^32; size, speed and look derive from it
    std::uint32_t* state;  ///< bits 0-7 Fate, bits 8-15 emitter index
};

/// Bytes of simulated state that one flake takes: eleven 4-byte arrays.
inline constexpr std::size_t kStateBytesPerFlake = 44;
/// Bytes of draw list that one flake takes: two 8-byte arrays between which sorts may ping-pong.
inline constexpr std::size_t kDrawListBytesPerFlake = 16;

/// Depth-keyed slots of the visible flakes, over memory that somebody else owns. An element is
/// key << 32 | slot; ascending order is far to near.
struct DrawListView
{
    std::uint64_t* pairs;
    std::uint64_t* scratch;
};

/// Where the flakes of a run are; emitted == alive + left + landed + vanished at every moment.
struct FlakeCounts
{
    std::uint64_t emitted = 0;
    std::uint64_t alive = 0;
    std::uint64_t left = 0;
    std::uint64_t landed = 0;
    std::uint64_t vanished = 0;
    std::uint64_t withheld = 0;  ///< due for emission but without room (capacity); not emitted
};

}  // namespace spindrift
