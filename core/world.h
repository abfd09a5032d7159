// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "core/drift.h"
#include "core/vec.h"

namespace spindrift
{

// Everything that the flakes of a run meet, as plain data in the local frame (metres, seconds, z up, origin
// at the lower corner of the domain). Made from a Scene once, then never changed.

/// What happens to a flake that crosses the border of the domain.
enum class OnLeave : std::uint32_t
{
    remove,   ///< counted as left
    respawn,  ///< counted as left; its emitter makes a new one (counted as emitted)
    wrap,     ///< comes in again on the opposite side (x and y; top and bottom remove)
};

/// What happens to a flake that touches a surface.
enum class Contact : std::uint32_t
{
    land,
    bounce,
    vanish,
};

enum class EmitterShape : std::uint32_t
{
    point,
    line,            ///< from `a` to `b`
    sphere_surface,  ///< uniform on the sphere of `radius_m` round `a`
    sphere_volume,   ///< uniform in it
    plane,           ///< parallelogram: a + s (b - a) + t (c - a)
    box,             ///< axes-parallel, from `a` to `b`
    sky,    ///< box of size `b` centred on `a`, or on a moving anchor; wraps; keeps `burst` flakes alive
    drift,  ///< the ground below the box from `a` to `b`: snow that the wind takes up; last among emitters
};

struct Emitter
{
    EmitterShape shape = EmitterShape::point;
    Vec3f a{}, b{}, c{};
    float radius_m = 0;          ///< sphere; drift: height of the saltation layer
    float lift_m_s = 0;          ///< drift: K_zz / z, for what hangs in the air at the start
    double rate_per_s = 0;       ///< drawn flakes per second; exact in the long run for any dt
    std::uint64_t burst = 0;     ///< drawn flakes at t = 0
    Vec3f velocity_m_s{};        ///< at emission, relative to the ground
    bool at_rest_in_air = true;  ///< ignore velocity_m_s: start at the speed of the air plus settling
    int anchor = -1;             ///< sky only: index of the moving anchor that it follows, -1: fixed
};

/// Size and fall speed of the flakes. PHYSICS: docs/physics.md "Flakes".
enum class Crystal : std::uint32_t
{
    dendrites,  ///< aggregates of unrimed dendrites: v = 0.8 D^0.16
    plates,     ///< aggregates of plates and columns: 0.69 D^0.41
    rimed,      ///< densely rimed dendrites: 0.62 D^0.33
    graupel,    ///< lump graupel: 1.3 D^0.66
};

enum class SizeSpectrum : std::uint32_t
{
    gunn_marshall,
    sekhon_srivastava,
};

struct Snow
{
    Crystal crystal = Crystal::dendrites;
    SizeSpectrum spectrum = SizeSpectrum::gunn_marshall;
    float rate_mm_h = 1.0F;              ///< water equivalent
    float fall_speed_spread_m_s = 0.1F;  ///< standard deviation between flakes of one size
    float fall_speed_m_s = -1;           ///< of every size; 0: a tracer; negative: by crystal and size
    float weight =
        1.0F;  ///< real flakes that one drawn flake stands for; > 0; used wherever light is counted
    bool inertia = false;  ///< velocities follow the air within v_t / g instead of at once
    float crossing = 0;    ///< beta: how fast a flake falls out of its eddies; 0: it stays in them
};

/// One wind cell: four 16-byte records that a GPU reads whole. Sampled trilinearly between cell centres.
/// S is the lower-triangular root of the stress tensor (u' = S q), div_s its divergence d_i S_ij per column
/// j (1/s), gradient the largest |dS/dx| (1/s), c0_eps that of the Langevin model (m2/s3).
struct alignas(64) WindCell
{
    float u, v, w, gradient;
    float s11, s21, s22, s31;
    float s32, s33, div_s1, div_s2;
    float div_s3, c0_eps, unused[2];
};

enum class WindKind : std::uint32_t
{
    uniform,
    logarithmic,
    grid,
};

struct Wind
{
    WindKind kind = WindKind::uniform;
    bool turbulent = false;  ///< false: q is neither read nor written

    Vec3f uniform_m_s{};  ///< uniform

    // logarithmic profile with the neutral surface-layer closure (docs/physics.md "Wind")
    float friction_velocity_m_s = 0;
    float roughness_m = 0.1F;
    float ground_m = 0;             ///< height of the ground in the local frame
    float boundary_layer_m = 1000;  ///< zi
    float to_x = 1, to_y = 0;       ///< unit vector along the wind

    // grid
    int nx = 0, ny = 0, nz = 0;
    Vec3f origin_m{};  ///< centre of cell (0,0,0)
    Vec3f cell_m{1, 1, 1};
    std::vector<WindCell> cells;  ///< x fastest, then y, then z
};

/// Occupancy of space for the cell-by-cell walk. `clearance` is the Chebyshev distance in cells to the
/// nearest solid (0: solid, capped at 255): a flake in a cell of clearance c that moves at most (c - 1) cells
/// per axis needs no walk.
struct VoxelGrid
{
    int nx = 0, ny = 0, nz = 0;  ///< 0: nothing solid but the ground
    Vec3f origin_m{};            ///< lower corner of cell (0,0,0)
    float cell_m = 1;
    std::vector<std::uint8_t> clearance;  ///< x fastest, then y, then z
    std::vector<std::uint8_t> surface;    ///< for solid cells: index into World::surfaces
};

struct Surface
{
    Contact contact = Contact::land;
    float restitution = 0.3F;  ///< bounce: share of the normal speed that is kept, 0..1
};

/// A moving point (camera or vehicle) that sky emitters follow: piecewise linear in time, held at both ends.
struct Anchor
{
    struct Key
    {
        double time_s;
        Vec3f position_m;
    };
    std::vector<Key> keys;  ///< ascending time, at least one
};

struct World
{
    Vec3f size_m{1, 1, 1};  ///< the domain is [0, size]
    OnLeave on_leave = OnLeave::respawn;
    double step_s = 1.0 / 60.0;
    std::uint64_t seed = 1;
    std::uint64_t capacity = 0;  ///< slots; fixed for the run
    Snow snow;
    Wind wind;
    std::vector<Emitter> emitters;  ///< at most 255
    GrainLaw grains;                ///< of what drift emitters make
    bool has_ground = true;
    float ground_m = 0;  ///< plane; a height field is voxelised into `voxels`
    Surface ground;
    VoxelGrid voxels;
    std::vector<Surface> surfaces;  ///< at most 256
    std::vector<Anchor> anchors;
};

}  // namespace spindrift
