// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "core/flake.h"
#include "core/flake_extent.h"
#include "core/vec.h"
#include "core/view.h"

namespace spindrift
{

/// Everything that a run can be continued from: with the same World it gives the same states, bit for bit.
struct Snapshot
{
    std::uint64_t world_hash = 0;  ///< of the World that it belongs to
    std::uint64_t step = 0;
    std::uint64_t next_id = 0;
    FlakeCounts counts;
    std::vector<std::uint64_t> emitter_state;  ///< backend-neutral, see cpu/emission
    std::vector<std::vector<std::uint32_t>>
        arrays;  ///< the eleven arrays of FlakeView as bits, alive flakes only
};

/// Which flakes to draw and in which order.
struct DrawList
{
    bool in_scratch = false;  ///< the sorted pairs lie in DrawListView::scratch, not in ::pairs
    std::uint64_t count = 0;
    std::uint64_t culled = 0;  ///< alive but outside the view
    bool sorted = false;
    std::uint64_t slots = 0;  ///< of the flakes that whoever draws can read, holes included
};

/// A stage that nobody timed.
inline constexpr double kNotMeasured = __builtin_nan("");

/// Milliseconds of the newest call whose times are known, by stage; or kNotMeasured. On a device they are the
/// device's own.
struct StageTimes
{
    double emit = kNotMeasured, advect = kNotMeasured, compact = kNotMeasured;
    double step = kNotMeasured;  ///< the three together, where the clock is not the caller's
    double cull = kNotMeasured, sort = kNotMeasured;
};

struct SortSettings
{
    std::string strategy = "auto";  ///< a name from the backend's table; auto: its exact sort of general use
    int depth_bits = 32;            ///< 32, 24 or 16
    int passes_per_frame = 8;       ///< steps that a sort over frames takes; at least 1
};

/// Moves and orders the flakes of one World. Implementations: cpu::CpuBackend, gpu::CudaBackend.
class Backend
{
  public:
    virtual ~Backend() = default;

    virtual std::string name() const = 0;  ///< "cpu (avx512, 2 threads)"

    /// Takes the flakes' memory from GL: between open() and close() the backend writes it and GL must not
    /// read. What needs the memory opens it by itself. A backend that shares memory with GL has nothing to
    /// do.
    virtual void open() {}
    /// Gives the flakes, and the list that prepare() returned, to whoever draws.
    virtual void close(const DrawList&) {}
    /// Waits until all that was asked for is done; counts() are those of step_number() afterwards. A backend
    /// whose calls return only when they are done has nothing to do.
    virtual void finish() {}

    /// Advances by one step of World::step_s: emission, wind, turbulence, settling, contacts, borders.
    virtual void step() = 0;

    /// Fills the draw list: culls against the view, makes depth keys, sorts far to near. Equal keys order by
    /// id. Throws Error for a strategy that this backend has not got.
    virtual DrawList prepare(const View& view, const SortSettings& sort) = 0;

    /// The newest that are known; a device may be some steps ahead of them until finish() or prepare().
    virtual FlakeCounts counts() const = 0;
    virtual std::uint64_t step_number() const = 0;
    virtual std::uint64_t slots_used() const = 0;  ///< holes included

    /// Order-independent 64-bit hash of every alive flake's state and of the counts.
    virtual std::uint64_t state_hash() const = 0;

    /// Bounds of the living flakes, and how many have run away (there must be none). Waits.
    virtual FlakeExtent extent() const = 0;

    virtual Snapshot save() const = 0;
    /// Throws Error if the snapshot belongs to another World or does not fit.
    virtual void restore(const Snapshot& snapshot) = 0;

    virtual StageTimes times() const = 0;

    /// From now on World::anchors[index] stands still at this place (local frame), whatever its keys say: for
    /// cameras and vehicles that a person steers.
    virtual void set_anchor(int index, Vec3f position_m) = 0;
};

}  // namespace spindrift
