// SPDX-License-Identifier: MIT
// Project Prairie Grass (Barad 1958): near-neutral releases over short grass, crosswind-integrated
// concentrations on arcs. No constant here is fitted to them. Docs: docs/validation.md.
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include <fmt/format.h>

#include "core/error.h"
#include "validation/all_cases.h"
#include "validation/residence.h"

namespace spindrift::validation
{

namespace
{

constexpr double kRoughness_m = 0.006;  ///< Barad's site; 0.006 to 0.008 in the literature
constexpr double kSource_m = 0.46, kSampler_m = 1.5;
constexpr const char* kFile = "prairie_grass_neutral_arcs.csv";

struct Release
{
    std::string run;
    double friction_m_s = 0;
    std::map<double, double> observed;  ///< arc in m, C_y / Q in s/m2
};

std::vector<Release> read_releases(const std::filesystem::path& file)
{
    std::ifstream in(file);
    if (!in) throw Error(fmt::format("{}: cannot be read", file.string()));
    std::vector<Release> releases;
    std::string line;
    std::getline(in, line);
    for (int number = 2; std::getline(in, line); ++number)
    {
        std::istringstream fields(line);
        std::string field;
        std::vector<std::string> row;
        while (std::getline(fields, field, ',')) row.push_back(field);
        try
        {
            if (row.size() < 8) throw std::invalid_argument("columns");
            if (releases.empty() || releases.back().run != row[0])
                releases.push_back({row[0], std::stod(row[4]), {}});
            releases.back().observed[std::stod(row[6])] = std::stod(row[7]);
        }
        catch (const std::exception&)
        {
            throw Error(
                fmt::format("{}:{}: is no row of run,Q,hs,zr,ustar,L,arc,Cy/Q,...", file.string(), number));
        }
    }
    if (releases.empty()) throw Error(fmt::format("{}: holds no releases", file.string()));
    return releases;
}

/// A tracer from the source in the neutral surface layer of scenes.
World release_world(const Settings& settings, double dt, double friction_m_s)
{
    World w = empty_world(settings, dt, {240, 400, 150});
    w.on_leave = OnLeave::remove;
    w.wind.kind = WindKind::logarithmic;
    w.wind.turbulent = true;
    w.wind.friction_velocity_m_s = static_cast<float>(friction_m_s);
    w.wind.roughness_m = static_cast<float>(kRoughness_m);
    add_ground(w);
    const Vec3f source{20, 200, static_cast<float>(kSource_m)};
    add_burst(w, source, source);
    return w;
}

std::vector<Reading> model(const Settings& settings, double dt, double friction_m_s,
                           const std::vector<double>& arcs, std::uint64_t& rogue)
{
    std::vector<Sampler> samplers;
    for (const double arc : arcs) samplers.push_back({20 + arc, kSampler_m, 0.1 * arc, 0.3});
    ResidenceMeter meter(samplers);
    const World world = release_world(settings, dt, friction_m_s);
    FlakeRun run(world, settings);
    for (double t = 0; t < 150; t += dt)
    {
        run.step();
        meter.look(run, dt);
    }
    rogue += run.rogue();
    return meter.readings(settings.particles);
}

}  // namespace

Outcome validate_prairie_grass(const Settings& settings)
{
    Outcome outcome;
    if (settings.data_folder.empty() || !std::filesystem::exists(settings.data_folder / kFile))
    {
        outcome.skipped = fmt::format("no {} (name its folder with --data or SPINDRIFT_TEST_DATA)", kFile);
        return outcome;
    }
    const std::vector<Release> releases = read_releases(settings.data_folder / kFile);
    const std::vector<double> arcs = {50, 100, 200};
    for (const double dt : settings.dt_s)
    {
        std::uint64_t rogue = 0;
        double n = 0, o_sum = 0, p_sum = 0, square = 0, within = 0, log_ratio = 0, log_square = 0;
        std::map<double, std::pair<double, double>> by_arc;  // sums of observed and modelled
        for (const Release& release : releases)
        {
            const std::vector<Reading> readings = model(settings, dt, release.friction_m_s, arcs, rogue);
            for (std::size_t a = 0; a < arcs.size(); ++a)
            {
                const double o = release.observed.at(arcs[a]), p = readings[a].value;
                ++n, o_sum += o, p_sum += p, square += (o - p) * (o - p);
                within += p >= 0.5 * o && p <= 2 * o ? 1 : 0;
                log_ratio += std::log(o / p), log_square += std::log(o / p) * std::log(o / p);
                by_arc[arcs[a]].first += o, by_arc[arcs[a]].second += p;
            }
        }
        const std::string which = fmt::format("dt = {:g} s: ", dt);
        const double mg = std::exp(log_ratio / n), vg = std::exp(log_square / n);
        outcome.checks.push_back({which + "1 - FAC2", 1 - within / n, 0, 0, 0.1, Side::above});
        outcome.checks.push_back({which + "FB", 2 * (o_sum - p_sum) / (o_sum + p_sum), 0, 0, 0.2});
        outcome.checks.push_back({which + "NMSE", square * n / (o_sum * p_sum), 0, 0, 1.5, Side::above});
        outcome.checks.push_back({which + "MG", mg, 1, 0, 0.3});
        outcome.checks.push_back({which + "VG", vg, 1, 0, 3, Side::above});
        for (const auto& [arc, sums] : by_arc)
            outcome.checks.push_back({which + fmt::format("modelled over observed at {:g} m", arc),
                                      sums.second / sums.first, 1, 0, 0.5});
        outcome.checks.push_back({which + "rogue", static_cast<double>(rogue), 0, 0, 0});
    }
    return outcome;
}

}  // namespace spindrift::validation
