// SPDX-License-Identifier: MIT
// What is evenly spread must stay so, and the velocities must keep their stresses, however turbulence varies.
// Docs: docs/validation.md.
#include "validation/well_mixed.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "core/advect_job.h"
#include "validation/all_cases.h"

namespace spindrift::validation
{

namespace
{

struct Bin
{
    double count = 0, q1 = 0, q2 = 0, q3 = 0;  ///< squares
    double shear_off = 0, shear_variance = 0;  ///< of u'w' minus its truth
};

Air<double> air_at(const AdvectJob& job, const Vec3<double>& x)
{
    if (job.wind_kind == WindKind::logarithmic) return job.logarithmic.air(x);
    if (job.wind_kind == WindKind::uniform) return job.uniform.air(x);
    return job.grid.air(x);
}

/// What sums of n numbers of variance 1 and mean 0 show, squared and over their noise.
double squared_over_noise(double sum, double variance_of_sum)
{
    return variance_of_sum > 0 ? sum * sum / variance_of_sum : 0;
}

}  // namespace

double Mixing::entropy_sd() const
{
    return kMixedBins * std::sqrt(2.0 * (kMixedBins - 1)) / (2 * flakes);
}

double Mixing::variance_noise() const
{
    return std::sqrt(2.0 * kMixedBins / flakes);
}

Mixing mixing(const World& world, const FlakeRun& run, Along axis, double low_m, double high_m)
{
    const AdvectJob job = advect_job(world, world.wind.cells.data(), {});
    const FlakeView& f = run.flakes();
    std::array<Bin, kMixedBins> bins{};
    Mixing m;
    for (std::size_t i = 0; i < run.slots(); ++i)
    {
        if (!run.alive(i)) continue;
        const Vec3<double> x{f.x[i], f.y[i], f.z[i]}, q{f.q1[i], f.q2[i], f.q3[i]};
        const double share = ((axis == Along::x ? x.x : x.z) - low_m) / (high_m - low_m);
        Bin& bin = bins[static_cast<std::size_t>(std::clamp(share * kMixedBins, 0.0, kMixedBins - 1.0))];
        const Air<double> air = air_at(job, x);
        const Vec3<double> u = turbulent_velocity(air, q);
        const double xx = air.s11 * air.s11, xz = air.s11 * air.s31,
                     zz = air.s31 * air.s31 + air.s32 * air.s32 + air.s33 * air.s33;
        ++bin.count, ++m.flakes;
        bin.q1 += q.x * q.x, bin.q2 += q.y * q.y, bin.q3 += q.z * q.z;
        bin.shear_off += u.x * u.z - xz;
        bin.shear_variance += xx * zz + xz * xz;
    }
    for (const Bin& bin : bins)
    {
        const double p = bin.count * kMixedBins / m.flakes;
        if (p > 0) m.entropy += p * std::log(p);
        m.chi_square += m.flakes / kMixedBins * (p - 1) * (p - 1) / (kMixedBins - 1);
        m.density_rms += (p - 1) * (p - 1) / kMixedBins;
        for (const double square : {bin.q1, bin.q2, bin.q3})
            m.variance += squared_over_noise(square - bin.count, 2 * bin.count) / (3 * kMixedBins);
        m.shear += squared_over_noise(bin.shear_off, bin.shear_variance) / kMixedBins;
        const double along = bin.count > 0 ? (axis == Along::x ? bin.q1 : bin.q3) / bin.count - 1 : 1;
        m.variance_rms += along * along / kMixedBins;
    }
    m.density_rms = std::sqrt(m.density_rms);
    m.variance_rms = std::sqrt(m.variance_rms);
    return m;
}

World sinusoid_world(const Settings& settings, double dt)
{
    constexpr int kCells = 100;  // over one period; the grid goes half a period on, as half-way points do
    World w = empty_world(settings, dt, {1, 1, 200});
    w.wind = wind_along(Along::x, -0.5, 1.0 / kCells, 2 * kCells,
                        [](double x)
                        {
                            const double variance = 1.1 + std::sin(2 * std::numbers::pi * x);
                            return AirLevel{{}, {variance, 0, 0, 1, 0, 1}, 4 * std::pow(variance, 1.5)};
                        });
    add_burst(w, {0, 0, 99}, {1, 1, 101});
    return w;
}

namespace
{

/// All that one run is asked; `shear`: there is a u'w' to speak of.
void check_mixing(const std::string& which, const Mixing& m, const FlakeRun& run, std::uint64_t flakes,
                  bool shear, std::vector<Check>& checks)
{
    // five standard deviations of numbers that are squares: only an excess is a fault
    const auto excess = [&](const char* what, double measured, double degrees)
    {
        const double noise = std::sqrt(2 / degrees);
        checks.push_back({which + what, measured, 1, noise, 5 * noise, Side::above});
    };
    checks.push_back(
        {which + "entropy", m.entropy, m.entropy_noise(), m.entropy_sd(), 5 * m.entropy_sd(), Side::above});
    excess("chi-square of places / dof", m.chi_square, kMixedBins - 1);
    excess("var q by bin, square / noise", m.variance, 3 * kMixedBins);
    if (shear) excess("u'w' by bin, square / noise", m.shear, kMixedBins);
    checks.push_back({which + "rogue or lost",
                      static_cast<double>(run.rogue()) + static_cast<double>(flakes) - m.flakes, 0, 0, 0});
}

World channel_world(const Settings& settings, double dt)
{
    constexpr double kFriction = 0.3, kHalf = 1;  // m/s, m
    constexpr int kCells = 100;
    World w = empty_world(settings, dt, {40, 40, 2});
    w.wind = wind_along(
        Along::z, 0, 2 * kHalf / kCells, kCells,
        [](double z)
        {
            const double d = std::min(z, 2 * kHalf - z) / kHalf;
            const double damped = 1 - std::exp(-d / 0.1), u2 = kFriction * kFriction;
            AirLevel air;
            air.mean_m_s.x = 3 * z * (2 * kHalf - z);
            air.stress = {u2 * (1 + 5 * std::exp(-d / 0.3)), 0, -u2 * damped * (1 - z / kHalf),
                          u2 * (0.7 + std::exp(-d / 0.4)),   0, u2 * (0.1 + 1.2 * damped * (1 - 0.4 * d))};
            air.c0_eps = 4 * u2 * kFriction / (kVonKarman * (d + 0.05) * kHalf);
            return air;
        });
    add_ground(w);
    add_lid(w, 2 * kHalf, 1);
    add_burst(w, {0, 0, 0}, {40, 40, 2 * kHalf});
    return w;
}

World surface_layer_world(const Settings& settings, double dt)
{
    constexpr float kTop = 5;  // m
    World w = empty_world(settings, dt, {100, 100, kTop});
    w.wind.kind = WindKind::logarithmic;
    w.wind.turbulent = true;
    w.wind.friction_velocity_m_s = 0.4F;
    w.wind.roughness_m = 0.05F;
    add_ground(w);
    add_lid(w, kTop, kTop);
    add_burst(w, {0, 0, 0}, {100, 100, kTop});
    return w;
}

Outcome sweep(const Settings& settings, World (*make)(const Settings&, double), double seconds, Along axis,
              double high_m, bool shear)
{
    Outcome outcome;
    for (const double dt : settings.dt_s)
    {
        const World world = make(settings, dt);
        FlakeRun run(world, settings);
        run.steps(static_cast<std::uint64_t>(std::ceil(seconds / dt - 1e-9)));
        check_mixing(fmt::format("dt = {:g} s: ", dt), mixing(world, run, axis, 0, high_m), run,
                     settings.particles, shear, outcome.checks);
    }
    return outcome;
}

}  // namespace

Outcome validate_sinusoid(const Settings& settings)
{
    return sweep(settings, sinusoid_world, 12, Along::x, 1, false);
}

Outcome validate_channel(const Settings& settings)
{
    return sweep(settings, channel_world, 20, Along::z, 2, true);
}

Outcome validate_surface_layer(const Settings& settings)
{
    return sweep(settings, surface_layer_world, 30, Along::z, 5, true);
}

}  // namespace spindrift::validation
