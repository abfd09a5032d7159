// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include "core/backend.h"
#include "core/world.h"
#include "cpu/cpu_backend.h"

namespace spindrift::cpu::test
{

/// Fills `clearance` from a predicate of solid cells, by brute force.
VoxelGrid voxels(int nx, int ny, int nz, float cell_m, const std::function<bool(int, int, int)>& solid,
                 const std::function<std::uint8_t(int, int, int)>& surface);

/// A wind grid whose cells are given by the position of their centres.
Wind grid_wind(int nx, int ny, int nz, Vec3f origin_m, Vec3f cell_m,
               const std::function<WindCell(float x, float y, float z)>& cell);

/// Isotropic turbulence: S = sigma I with relaxation rate `rate`, no gradient.
WindCell isotropic(float sigma_m_s, float rate_per_s);

/// 40 x 30 x 20 m with everything at once: grid wind with shear stress and gradients, ground, walls that
/// land, bounce and swallow, every kind of emitter, a sky that moves.
World world_with_everything(std::uint64_t capacity, OnLeave on_leave, bool turbulent);

/// The same in a wind that turns round within a second, falls to half and then holds on, with gusts, a
/// vehicle and one that stands.
World world_with_changing_wind(std::uint64_t capacity);

/// A backend with its own memory.
struct TestRun
{
    HostFlakes memory;
    FlakeView flakes;
    std::unique_ptr<Backend> backend;

    explicit TestRun(const World& world, CpuOptions options = {});
    void steps(int n);
    Backend* operator->() const { return backend.get(); }
};

/// Of the slots in use whose flakes live.
std::uint64_t recount_alive(const TestRun& run);

/// Flakes that live inside a solid, below the ground, or at a place that is not finite.
std::uint64_t misplaced(const World& world, const TestRun& run);

}  // namespace spindrift::cpu::test
