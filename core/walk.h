// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/flake.h"
#include "core/math.h"
#include "core/vec.h"
#include "core/world.h"

namespace spindrift
{

/// A voxel grid without ownership, as kernels see it.
struct Voxels
{
    int nx = 0, ny = 0, nz = 0;  ///< 0: nothing solid
    Vec3f origin_m{};
    float cell_m = 1;
    float cells_per_m = 1;  ///< 1 / cell_m
    /// As VoxelGrid::clearance. Packs read it in words: 3 bytes behind its end must be readable.
    const std::uint8_t* clearance = nullptr;
    const std::uint8_t* surface = nullptr;

    /// Of the cell that holds a coordinate; outside the grid it goes on counting.
    template <class R>
    SPINDRIFT_HD IntOf<R> cell_index(const R& coordinate, float origin) const
    {
        return floor_to_int((coordinate - number<R>(origin)) * number<R>(cells_per_m));
    }

    /// Chebyshev distance in cells from a cell to the nearest solid one, or less; 0: solid. Large without
    /// voxels.
    template <class Int>
    SPINDRIFT_HD Int clearance_at(const Int& x, const Int& y, const Int& z) const
    {
        if (nx == 0) return Int(1 << 24);
        const Int zero(0);
        const Int i = min(max(x, zero), Int(nx - 1));
        const Int j = min(max(y, zero), Int(ny - 1));
        const Int k = min(max(z, zero), Int(nz - 1));
        const Int outside = max(max(max(x - i, i - x), max(y - j, j - y)), max(z - k, k - z));
        const Int inside = gather_bytes(clearance, (k * Int(ny) + j) * Int(nx) + i);
        return select(outside > zero, outside, inside);
    }

    template <class R>
    SPINDRIFT_HD IntOf<R> clearance_of(const Vec3<R>& p) const
    {
        return clearance_at(cell_index(p.x, origin_m.x), cell_index(p.y, origin_m.y),
                            cell_index(p.z, origin_m.z));
    }

    template <class R>
    SPINDRIFT_HD MaskOf<R> is_solid(const Vec3<R>& p) const
    {
        return clearance_of(p) == IntOf<R>(0);
    }
};

inline Voxels voxels_view(const VoxelGrid& grid)
{
    Voxels v;
    v.nx = grid.nx;
    v.ny = grid.ny;
    v.nz = grid.nz;
    v.origin_m = grid.origin_m;
    v.cell_m = grid.cell_m;
    v.cells_per_m = 1.0F / grid.cell_m;
    v.clearance = grid.clearance.data();
    v.surface = grid.surface.data();
    return v;
}

/// The solid things of a World without ownership.
struct Solids
{
    Voxels voxels;
    const Surface* surfaces = nullptr;  ///< by Voxels::surface
    bool has_ground = false;
    float ground_m = 0;
    Surface ground;
};

inline Solids solids_view(const World& world)
{
    return {voxels_view(world.voxels), world.surfaces.data(), world.has_ground, world.ground_m, world.ground};
}

/// True where a flake may move by `displacement` at once: nothing solid can be in between. False for what is
/// not finite. A test on packs before the lanes that need it walk one by one.
template <class R>
SPINDRIFT_HD MaskOf<R> moves_freely(const Solids& solids, const Vec3<R>& start, const Vec3<R>& displacement)
{
    const R one = number<R>(1);
    const R clearance = to_real<R>(solids.voxels.clearance_of(start));
    const R length = max(max(abs(displacement.x), abs(displacement.y)), abs(displacement.z));
    // max drops a NaN in its first operand: the sum catches it
    const R sum = start.x + start.y + start.z + displacement.x + displacement.y + displacement.z;
    // a 128th less than the free cells: room for rounding of positions in grids of up to 2^16 cells
    auto free =
        length * number<R>(solids.voxels.cells_per_m) <= (clearance - one) * number<R>(1.0 - 0x1p-7) &&
        is_finite(sum);
    if (solids.has_ground)
    {
        const R ground = number<R>(solids.ground_m);
        free = free && start.z >= ground && start.z + displacement.z >= ground;
    }
    return free;
}

/// Why a walk did not do what was asked.
enum class WalkFault : std::uint32_t
{
    none,
    not_finite,    ///< start or displacement is NaN, infinite or beyond 2^22 cells: no move
    began_inside,  ///< the start lies in a solid or below the ground: the flake vanishes there
    gave_up,       ///< more contacts and cells than kMostWalkEvents: it stays where it had come to
};

inline constexpr int kMostWalkEvents = 4096;
inline constexpr int kNoSurface = -1;
inline constexpr int kGroundSurface = -2;

/// Where a displacement ends among solids.
template <class R>
struct WalkResult
{
    Vec3<R> end{};
    Fate fate = Fate::alive;     ///< alive, landed or vanished
    std::uint32_t mirrored = 0;  ///< bit k: the flake flies mirrored along axis k (an odd number of bounces)
    std::uint32_t turned = 0;    ///< bit k: it bounced along axis k
    Vec3<R> kept{R(1), R(1),
                 R(1)};  ///< factor of its own velocity per axis: product of -restitution over bounces
    int bounces = 0;
    int surface = kNoSurface;  ///< last touched: index into World::surfaces, or kGroundSurface
    WalkFault fault = WalkFault::none;
};

/// Moves a point by a displacement through the cells of a voxel grid and above the ground plane, cell by
/// cell, so that no length tunnels. R: float or double. Free space is skipped by its clearance. At a bouncing
/// face that component of the rest of the displacement changes sign, so the path keeps its length; at a face
/// where it lands or vanishes it ends just outside the solid. It never ends inside a solid. A start on the
/// very face of a solid counts as outside; an edge or corner that is met exactly counts as met. Source:
/// Amanatides and Woo, "A fast voxel traversal algorithm for ray tracing", Eurographics 1987.
template <class R>
class VoxelWalker
{
  public:
    SPINDRIFT_HD explicit VoxelWalker(const Solids& solids) : solids_(solids) {}

    /// To its end, through all bounces.
    SPINDRIFT_HD WalkResult<R> operator()(const Vec3<R>& start, const Vec3<R>& displacement)
    {
        if (go(start, displacement)) finish_whole(start, displacement);
        return result_;
    }

  private:
    static constexpr int kNoAxis = -1;

    /// True if the whole displacement was gone.
    SPINDRIFT_HD bool go(const Vec3<R>& start, const Vec3<R>& displacement)
    {
        result_ = WalkResult<R>{};
        result_.end = start;
        time_ = R(0);
        if (!begin(start, displacement)) return false;
        for (int events = 0; time_ < R(1); ++events)
        {
            if (events == kMostWalkEvents)
            {
                result_.fault = WalkFault::gave_up;
                finish(kNoAxis, R(0));
                return false;
            }
            if (!advance()) return false;
        }
        return true;
    }

    /// Position = sign (from + speed time) + offset, in cells: a bounce changes sign and offset only, so that
    /// no number of bounces adds up rounding errors.
    struct Axis
    {
        R from, speed, sign, offset;
        int cell;
        SPINDRIFT_HD R at(R time) const { return sign * (from + speed * time) + offset; }
        SPINDRIFT_HD R time_of(R place) const { return (sign * (place - offset) - from) / speed; }
        SPINDRIFT_HD bool rises() const { return sign * speed > R(0); }
        SPINDRIFT_HD bool falls() const { return sign * speed < R(0); }
        SPINDRIFT_HD void mirror(R face)
        {
            sign = -sign;
            offset = face + face - offset;
        }
    };

    SPINDRIFT_HD R origin(int k) const
    {
        return R(k == 0   ? solids_.voxels.origin_m.x
                 : k == 1 ? solids_.voxels.origin_m.y
                          : solids_.voxels.origin_m.z);
    }
    SPINDRIFT_HD R to_metres(int k, R cells) const { return origin(k) + cells * R(solids_.voxels.cell_m); }
    SPINDRIFT_HD int clearance(int x, int y, int z) const { return solids_.voxels.clearance_at(x, y, z); }
    SPINDRIFT_HD int surface_at(int x, int y, int z) const
    {
        const Voxels& v = solids_.voxels;
        return v.surface[(std::int64_t{z} * v.ny + y) * v.nx + x];
    }
    SPINDRIFT_HD bool inside_solid(const Vec3<R>& p) const
    {
        if (solids_.has_ground && p.z < R(solids_.ground_m)) return true;
        return solids_.voxels.is_solid(p);
    }

    /// False if the walk is over before it began.
    SPINDRIFT_HD bool begin(const Vec3<R>& start, const Vec3<R>& displacement)
    {
        const R p[3] = {start.x, start.y, start.z};
        const R d[3] = {displacement.x, displacement.y, displacement.z};
        const R scale = R(solids_.voxels.cells_per_m);
        for (int k = 0; k < 3; ++k)
        {
            Axis& axis = axes_[k];
            axis.from = (p[k] - origin(k)) * scale;
            axis.sign = R(1);
            axis.offset = R(0);
            axis.speed = d[k] * scale;
            if (!(abs(axis.from) < R(0x1p22) && abs(axis.speed) < R(0x1p22)))
            {
                result_.fault = WalkFault::not_finite;
                return false;
            }
            axis.cell = floor_to_int(axis.from);
        }
        ground_ = (R(solids_.ground_m) - origin(2)) * scale;
        if (leave_faces() && !(solids_.has_ground && start.z < R(solids_.ground_m))) return true;
        result_.fault = WalkFault::began_inside;
        result_.surface = kGroundSurface;
        if (clearance(axes_[0].cell, axes_[1].cell, axes_[2].cell) == 0)
            result_.surface = surface_at(axes_[0].cell, axes_[1].cell, axes_[2].cell);
        result_.fate = Fate::vanished;
        return false;
    }

    /// A point on the lower face of a solid cell belongs to the free cell on the other side, if there is one.
    SPINDRIFT_HD bool leave_faces()
    {
        for (int back = 0; back < 8; ++back)
        {
            int cell[3];
            bool possible = true;
            for (int k = 0; k < 3; ++k)
            {
                const int step = (back >> k) & 1;
                cell[k] = axes_[k].cell - step;
                possible = possible && (step == 0 || axes_[k].from == to_real<R>(axes_[k].cell));
            }
            if (!possible || clearance(cell[0], cell[1], cell[2]) == 0) continue;
            for (int k = 0; k < 3; ++k) axes_[k].cell = cell[k];
            return true;
        }
        return false;
    }

    /// On to the next face, or across free space; false if the flake stops.
    SPINDRIFT_HD bool advance()
    {
        const R never = infinity<R>();
        const R ground_time = solids_.has_ground && axes_[2].falls() ? axes_[2].time_of(ground_) : never;
        const int free_cells = clearance(axes_[0].cell, axes_[1].cell, axes_[2].cell) - 1;
        if (free_cells > 0) return jump(free_cells, ground_time);

        int next = kNoAxis;
        R next_time = never;
        for (int k = 0; k < 3; ++k)
        {
            const Axis& axis = axes_[k];
            if (axis.speed == R(0)) continue;
            const R face = to_real<R>(axis.rises() ? axis.cell + 1 : axis.cell);
            const R time = axis.time_of(face);
            if (time < next_time) next = k, next_time = time;
        }
        if (ground_time <= next_time && ground_time < R(1)) return touch_ground(ground_time);
        time_ = min(max(next_time, time_), R(1));
        if (time_ >= R(1)) return true;
        return cross(next);
    }

    SPINDRIFT_HD bool jump(int free_cells, R ground_time)
    {
        const R speed = max(max(abs(axes_[0].speed), abs(axes_[1].speed)), abs(axes_[2].speed));
        // the same share as in moves_freely
        const R time = speed > R(0) ? time_ + R(free_cells) * R(1.0 - 0x1p-7) / speed : R(1);
        if (ground_time <= time && ground_time < R(1))
        {
            for (int k = 0; k < 3; ++k) axes_[k].cell = floor_to_int(axes_[k].at(max(ground_time, time_)));
            return touch_ground(ground_time);
        }
        time_ = min(time, R(1));
        for (Axis& axis : axes_) axis.cell = floor_to_int(axis.at(time_));
        return true;
    }

    SPINDRIFT_HD bool cross(int k)
    {
        Axis& axis = axes_[k];
        const int step = axis.rises() ? 1 : -1;
        const R face = to_real<R>(step > 0 ? axis.cell + 1 : axis.cell);
        int cell[3] = {axes_[0].cell, axes_[1].cell, axes_[2].cell};
        cell[k] += step;
        if (clearance(cell[0], cell[1], cell[2]) != 0)
        {
            axis.cell = cell[k];
            return true;
        }
        result_.surface = surface_at(cell[0], cell[1], cell[2]);
        return meet(k, face, solids_.surfaces[result_.surface]);
    }

    SPINDRIFT_HD bool touch_ground(R ground_time)
    {
        time_ = max(ground_time, time_);
        result_.surface = kGroundSurface;
        return meet(2, ground_, solids_.ground);
    }

    SPINDRIFT_HD bool meet(int k, R face, const Surface& surface)
    {
        Axis& axis = axes_[k];
        if (surface.contact != Contact::bounce)
        {
            result_.fate = surface.contact == Contact::land ? Fate::landed : Fate::vanished;
            finish(k, face);
            return false;
        }
        axis.mirror(face);
        result_.mirrored ^= 1U << k;
        result_.turned |= 1U << k;
        ++result_.bounces;
        R& kept = k == 0 ? result_.kept.x : k == 1 ? result_.kept.y : result_.kept.z;
        kept = kept * -R(surface.restitution);
        return true;
    }

    /// Ends here and now; `contact` is the axis of the face that it touches.
    SPINDRIFT_HD void finish(int contact, R face)
    {
        R end[3];
        for (int k = 0; k < 3; ++k) end[k] = to_metres(k, k == contact ? face : axes_[k].at(time_));
        if (contact == 2 && result_.surface == kGroundSurface) end[2] = R(solids_.ground_m);
        result_.end = keep_outside({end[0], end[1], end[2]});
    }

    /// Ends after the whole displacement: axes that never turned get start + displacement, as a flake in free
    /// space does.
    SPINDRIFT_HD void finish_whole(const Vec3<R>& start, const Vec3<R>& displacement)
    {
        const Vec3<R> straight = start + displacement;
        const auto turned = [this](int k) { return ((result_.turned >> k) & 1U) != 0; };
        Vec3<R> end{turned(0) ? to_metres(0, axes_[0].at(R(1))) : straight.x,
                    turned(1) ? to_metres(1, axes_[1].at(R(1))) : straight.y,
                    turned(2) ? to_metres(2, axes_[2].at(R(1))) : straight.z};
        result_.end = keep_outside(end);
    }

    /// Rounding may put the end on or behind a face: then it goes into the cell that the walk has reached, a
    /// 4096th of its size off the faces (more where coordinates are too coarse for that).
    SPINDRIFT_HD Vec3<R> keep_outside(Vec3<R> p) const
    {
        const R ground = R(solids_.ground_m);
        if (solids_.has_ground && p.z < ground) p.z = ground;
        R inset = R(0x1p-12);
        for (int attempt = 0; attempt < 3 && inside_solid(p); ++attempt, inset = inset * R(32))
        {
            const R half = R(0.5);
            p.x = held(0, p.x, min(inset, half));
            p.y = held(1, p.y, min(inset, half));
            p.z = held(2, p.z, min(inset, half));
            if (solids_.has_ground && p.z < ground) p.z = ground;
        }
        return p;
    }
    SPINDRIFT_HD R held(int k, R p, R inset) const
    {
        const R low = to_metres(k, to_real<R>(axes_[k].cell) + inset);
        const R high = to_metres(k, to_real<R>(axes_[k].cell + 1) - inset);
        return clamp(p, low, high);
    }

    Solids solids_;
    WalkResult<R> result_;
    Axis axes_[3];
    R time_{};
    R ground_{};  ///< height of the ground in cells
};

}  // namespace spindrift
