// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>

#include "core/backend.h"
#include "core/turbulence.h"
#include "core/world.h"
#include "cpu/cpu_backend.h"
#include "validation/check.h"

namespace spindrift::validation
{

/// The air at one height (or place along the line that a wind varies on).
struct AirLevel
{
    Vec3d mean_m_s{};
    Stress<double> stress{};
    double c0_eps = 0;
};

/// Air that is the same everywhere. `rate_per_s` is 1 / T of the isotropic case: C0 eps = 2 sigma^2 / T.
AirLevel isotropic(double sigma_m_s, double rate_per_s);

enum class Along
{
    x,
    z,
};

/// A wind grid of n cells along one axis and one along the others, made from mean, stress and dissipation as
/// a scene's wind is.
Wind wind_along(Along axis, double low_m, double cell_m, int n,
                const std::function<AirLevel(double)>& air_at);

/// The same air everywhere.
Wind wind_everywhere(const AirLevel& air);

/// A domain without ground, walls or emitters; flakes are tracers that wrap along x and y.
World empty_world(const Settings& settings, double step_s, Vec3f size_m);

/// A perfectly bouncing ground at z = 0.
void add_ground(World& world);
/// A perfectly bouncing lid at `height_m`, a multiple of `cell_m`; the domain ends one cell above it.
void add_lid(World& world, float height_m, float cell_m);

/// All flakes at t = 0, in [low, high) or, if they are equal, at a point.
void add_burst(World& world, Vec3f low, Vec3f high);

/// A world on the CPU backend, in memory of its own.
class FlakeRun
{
  public:
    FlakeRun(const World& world, const Settings& settings, cpu::CpuOptions options = {});
    void step() { backend_->step(); }
    void steps(std::uint64_t n);
    const FlakeView& flakes() const { return flakes_; }
    std::size_t slots() const { return backend_->slots_used(); }
    bool alive(std::size_t slot) const { return (flakes_.state[slot] & 0xFFU) == 0; }
    const Backend& backend() const { return *backend_; }

    /// Flakes that have no finite place or are lost from the balance of counts: there must be none.
    std::uint64_t rogue() const;

  private:
    cpu::HostFlakes memory_;
    FlakeView flakes_;
    std::unique_ptr<Backend> backend_;
};

/// "0.05" as people write it.
std::string short_number(double value);

}  // namespace spindrift::validation
