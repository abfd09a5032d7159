// SPDX-License-Identifier: MIT
// A steady plume in homogeneous turbulence over a reflecting ground, without and with a lid: Gaussian with
// images, its widths after Taylor. Docs: docs/validation.md.
#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "validation/all_cases.h"
#include "validation/homogeneous.h"
#include "validation/worlds.h"

namespace spindrift::validation
{

namespace
{

constexpr double kWind = 5, kSigma = 0.5, kTime_s = 4;  // m/s, m/s, s
constexpr double kHeight = 5, kLid = 20;                // m

/// Where flakes cross planes across the wind.
struct Plane
{
    double x_m;
    std::vector<double> y, z;
};

/// Share of a plume at `height_m` within [low, high) after it has spread by `sigma_m`, with the images in the
/// ground and, if lid_m > 0, in the lid.
double share_between(double low, double high, double height_m, double sigma_m, double lid_m)
{
    const auto below = [&](double z, double middle)
    { return 0.5 * std::erf((z - middle) / (sigma_m * std::sqrt(2.0))); };
    const int images = lid_m > 0 ? 20 : 0;
    double share = 0;
    for (int n = -images; n <= images; ++n)
        for (const double side : {1.0, -1.0})
        {
            const double middle = side * height_m + 2 * n * lid_m;
            share += below(high, middle) - below(low, middle);
        }
    return share;
}

World plume_world(const Settings& settings, double dt, bool lid)
{
    const double middle = 150;
    World w = empty_world(settings, dt, {320, 300, 120});
    w.on_leave = OnLeave::remove;
    // along the wind as little turbulence as a realizable stress may have: the formula neglects it
    AirLevel air = isotropic(kSigma, 1 / kTime_s);
    air.stress.xx = 0.021 * kSigma * kSigma;
    air.mean_m_s.x = kWind;
    w.wind = wind_everywhere(air);
    add_ground(w);
    if (lid) add_lid(w, static_cast<float>(kLid), 10);
    const Vec3f source{0, static_cast<float>(middle), static_cast<float>(kHeight)};
    add_burst(w, source, source);
    return w;
}

/// Steps until all have passed the last plane, and notes where each crosses them.
std::uint64_t follow(const World& world, const Settings& settings, std::vector<Plane>& planes)
{
    FlakeRun run(world, settings);
    const std::size_t n = settings.particles;
    const double dt = world.step_s;
    std::vector<Vec3f> before(n, {0, 150, static_cast<float>(kHeight)});
    const auto steps = static_cast<int>(planes.back().x_m / kWind / dt * 1.25) + 10;
    for (int s = 0; s < steps; ++s)
    {
        run.step();
        const FlakeView& f = run.flakes();
        for (std::size_t i = 0; i < run.slots(); ++i)
        {
            Vec3f& from = before[f.id[i]];
            const Vec3f to{f.x[i], f.y[i], f.z[i]};
            for (Plane& plane : planes)
                if (from.x < plane.x_m && to.x >= plane.x_m)
                {
                    const double part = (plane.x_m - from.x) / static_cast<double>(to.x - from.x);
                    plane.y.push_back(from.y + part * (to.y - from.y) - 150);
                    plane.z.push_back(from.z + part * (to.z - from.z));
                }
            from = to;
        }
    }
    return run.rogue();
}

/// Largest deviation of the counts in cells of equal share, in their own standard deviations.
template <class Share>
double worst_cell(const std::vector<double>& at, double low, double high, int cells, const Share& share)
{
    std::vector<double> count(static_cast<std::size_t>(cells), 0);
    const double width = (high - low) / cells;
    for (const double v : at)
        if (v >= low && v < high) ++count[static_cast<std::size_t>(std::min((v - low) / width, cells - 1.0))];
    const double n = static_cast<double>(at.size());
    double worst = 0;
    for (int c = 0; c < cells; ++c)
    {
        const double p = share(low + c * width, low + (c + 1) * width);
        const double noise = std::sqrt(n * p * (1 - p));
        const double off = std::abs(count[static_cast<std::size_t>(c)] - n * p) / noise;
        worst = std::max(worst, off);
    }
    return worst;
}

void check_plane(const Plane& plane, double lid_m, const std::string& which, std::uint64_t n,
                 std::vector<Check>& checks)
{
    const double times = plane.x_m / kWind / kTime_s;
    const double sigma = kSigma * kTime_s * std::sqrt(taylor_spread(times));
    const auto crossed = static_cast<double>(plane.y.size());
    double square = 0;
    for (const double y : plane.y) square += y * y / crossed;
    const std::string at = fmt::format("{}, x = {:g} U T: ", which, times);
    checks.push_back({at + "crossed, of all", crossed / static_cast<double>(n), 1, 0, 0});
    checks.push_back(
        sampled(at + "sigma y over Taylor's", std::sqrt(square) / sigma, 1, std::sqrt(0.5 / crossed), 4));
    const double top = lid_m > 0 ? lid_m : kHeight + 2.5 * sigma;
    const double worst_z =
        worst_cell(plane.z, 0, top, 8,
                   [&](double low, double high) { return share_between(low, high, kHeight, sigma, lid_m); });
    const double worst_y = worst_cell(
        plane.y, -2.5 * sigma, 2.5 * sigma, 8,
        [&](double low, double high)
        { return 0.5 * (std::erf(high / sigma / std::sqrt(2.0)) - std::erf(low / sigma / std::sqrt(2.0))); });
    checks.push_back({at + "C(z), worst of 8 heights, in sd", worst_z, 0, 1, 4, Side::above});
    checks.push_back({at + "C(y), worst of 8 places, in sd", worst_y, 0, 1, 4, Side::above});
}

}  // namespace

Outcome validate_gaussian_plume(const Settings& settings)
{
    Outcome outcome;
    for (const double dt : settings.dt_s)
        for (const bool lid : {false, true})
        {
            std::vector<Plane> planes;
            for (const double times : {0.5, 2.0, 8.0}) planes.push_back({times * kWind * kTime_s, {}, {}});
            const World world = plume_world(settings, dt, lid);
            const std::uint64_t rogue = follow(world, settings, planes);
            const std::string which = fmt::format("dt = {:g} s, {}", dt, lid ? "lid" : "open");
            for (const Plane& plane : planes)
                check_plane(plane, lid ? kLid : 0, which, settings.particles, outcome.checks);
            outcome.checks.push_back({which + ": rogue", static_cast<double>(rogue), 0, 0, 0});
        }
    return outcome;
}

}  // namespace spindrift::validation
