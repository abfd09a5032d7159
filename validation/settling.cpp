// SPDX-License-Identifier: MIT
// Falls from rest and throws in still air against linear drag. Docs: docs/validation.md.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/advect.h"
#include "validation/all_cases.h"
#include "validation/worlds.h"

namespace spindrift::validation
{

namespace
{

/// Largest error of any flake's path at any step, m, against x = v_t t ... with tau = v_t / g.
double largest_error(const Settings& settings, double dt, double fall, Vec3f throw_m_s)
{
    World w = empty_world(settings, dt, {400, 400, 400});
    w.on_leave = OnLeave::remove;
    w.snow.fall_speed_m_s = static_cast<float>(fall);
    add_burst(w, {200, 200, 200}, {200, 200, 200});
    w.emitters[0].at_rest_in_air = false;
    w.emitters[0].velocity_m_s = throw_m_s;
    FlakeRun run(w, settings);
    const double tau = fall / kGravity;
    double worst = 0;
    const int steps = std::max(1, static_cast<int>(2 / dt));
    for (int s = 1; s <= steps; ++s)
    {
        run.step();
        const double t = s * dt, path = tau * (1 - std::exp(-t / tau));
        for (std::size_t i = 0; i < run.slots(); ++i)
        {
            const double x = 200 + throw_m_s.x * path;
            const double z = 200 - fall * t + (throw_m_s.z + fall) * path;
            worst = std::max({worst, std::abs(static_cast<double>(run.flakes().x[i]) - x),
                              std::abs(static_cast<double>(run.flakes().z[i]) - z)});
        }
    }
    return worst;
}

}  // namespace

Outcome validate_settling(const Settings& settings)
{
    Outcome outcome;
    for (const double dt : settings.dt_s)
        for (const double fall : {0.3, 1.0})
            for (const Vec3f thrown : {Vec3f{0, 0, 0}, Vec3f{6, 0, 4}})
            {
                // half a last place of 200 m in each of 2 / dt steps
                const double rounding = 7.6e-6 * std::max(1.0, 2 / dt);
                outcome.checks.push_back(
                    at_most(fmt::format("dt = {:g} s, v_t = {:g} m/s, {}: largest error of the path, m", dt,
                                        fall, thrown.x > 0 ? "thrown" : "from rest"),
                            largest_error(settings, dt, fall, thrown), rounding));
            }
    return outcome;
}

}  // namespace spindrift::validation
