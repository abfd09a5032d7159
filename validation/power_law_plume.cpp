// SPDX-License-Identifier: MIT
// A plume in wind and diffusivity that grow with height as powers: Roberts' closed form. Docs:
// docs/validation.md.
#include <cmath>

#include <fmt/format.h>

#include "validation/all_cases.h"
#include "validation/residence.h"

namespace spindrift::validation
{

namespace
{

// U = a z^p, K = b z^n, source at H
constexpr double kA = 4.8, kP = 0.15, kB = 0.08, kN = 1, kHeight = 4;
/// The shorter the turbulence's time K / sigma^2, the nearer is the walk to the diffusion that the formula
/// describes: 0.02 z / (1 m/s), against 30 s under way.
constexpr double kSigma = 2;

/// C_y / Q, s/m2; I_-nu by its series.
double roberts(double x, double z)
{
    const double alpha = 2 + kP - kN, nu = (1 - kN) / alpha;
    const double argument = 2 * kA * std::pow(z * kHeight, alpha / 2) / (kB * alpha * alpha * x);
    const double scale =
        std::exp(-kA * (std::pow(z, alpha) + std::pow(kHeight, alpha)) / (kB * alpha * alpha * x));
    double bessel = 0, term = std::pow(argument / 2, -nu) / std::tgamma(1 - nu);
    for (int k = 0; k < 500; ++k)
    {
        bessel += term;
        term *= argument * argument / 4 / ((k + 1) * (k + 1 - nu));
    }
    return std::pow(z * kHeight, (1 - kN) / 2) / (kB * alpha * x) * scale * bessel;
}

World power_law_world(const Settings& settings, double dt)
{
    constexpr double kTop = 60, kCell = 0.05;
    World w = empty_world(settings, dt, {260, 200, static_cast<float>(kTop)});
    w.on_leave = OnLeave::remove;
    w.wind = wind_along(Along::z, 0, kCell, static_cast<int>(kTop / kCell),
                        [](double z)
                        {
                            const double k = kB * std::pow(z, kN);
                            AirLevel air = isotropic(kSigma, kSigma * kSigma / k);
                            air.stress.xx = 0.021 * kSigma * kSigma;
                            air.mean_m_s.x = kA * std::pow(z, kP);
                            return air;
                        });
    add_ground(w);
    const Vec3f source{0, 100, static_cast<float>(kHeight)};
    add_burst(w, source, source);
    return w;
}

}  // namespace

Outcome validate_power_law_plume(const Settings& settings)
{
    Outcome outcome;
    for (const double dt : settings.dt_s)
    {
        std::vector<Sampler> samplers;
        for (const double x : {50.0, 100.0, 200.0})
            for (const double z : {1.0, 4.0, 8.0}) samplers.push_back({x, z, 10, 1});
        ResidenceMeter meter(samplers);
        const World world = power_law_world(settings, dt);
        FlakeRun run(world, settings);
        // until the slowest, near the ground, have passed
        for (const auto steps = static_cast<int>(150 / dt);
             run.backend().step_number() < static_cast<std::uint64_t>(steps);)
        {
            run.step();
            meter.look(run, dt);
        }
        const std::vector<Reading> readings = meter.readings(settings.particles);
        for (std::size_t s = 0; s < samplers.size(); ++s)
        {
            // mean of the formula over the sampler, by Simpson in height; along x it is smooth
            const auto [x, z, length, height] = samplers[s];
            const double truth =
                (roberts(x, z - height / 2) + 4 * roberts(x, z) + roberts(x, z + height / 2)) / 6;
            outcome.checks.push_back(
                sampled(fmt::format("dt = {:g} s: C at x = {:g} m, z = {:g} m over Roberts'", dt, x, z),
                        readings[s].value / truth, 1, readings[s].noise / truth, 4, 0.02));
        }
        outcome.checks.push_back(
            {fmt::format("dt = {:g} s: rogue", dt), static_cast<double>(run.rogue()), 0, 0, 0});
    }
    return outcome;
}

}  // namespace spindrift::validation
