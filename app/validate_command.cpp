// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>

#include <fmt/format.h>
#include <unistd.h>
#include <nlohmann/json.hpp>

#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/find_scene.h"
#include "core/error.h"
#include "validation/check.h"

namespace spindrift::app
{

namespace
{

using validation::Case;
using validation::Check;
using validation::Outcome;
using validation::Settings;
using Json = nlohmann::ordered_json;

std::vector<const Case*> chosen_cases(const std::vector<std::string>& names)
{
    std::vector<const Case*> chosen;
    std::string known;
    for (const Case& c : validation::cases()) known += (known.empty() ? "" : ", ") + c.name;
    for (const std::string& name : names)
        if (std::none_of(validation::cases().begin(), validation::cases().end(),
                         [&](const Case& c) { return c.name == name; }))
            throw Error(fmt::format("--case {}: there is no such case; use some of {}", name, known));
    for (const Case& c : validation::cases())
        if (names.empty() || std::find(names.begin(), names.end(), c.name) != names.end())
            chosen.push_back(&c);
    return chosen;
}

/// Field data may lie anywhere; nothing of it comes with the program.
std::filesystem::path data_folder(const ValidateOptions& options)
{
    if (!options.data.empty()) return options.data;
    const char* folder = std::getenv("SPINDRIFT_TEST_DATA");
    return folder != nullptr ? folder : "";
}

Settings settings_of(const Case& c, const ValidateOptions& options)
{
    const bool alone = !options.cases.empty();
    if (alone && options.particles && c.particles == 0)
        throw Error(fmt::format("--particles: the case {} has none; leave it out", c.name));
    if (alone && !options.dt_s.empty() && c.dt_s.empty())
        throw Error(fmt::format("--dt: the case {} has no time step to choose; leave it out", c.name));
    Settings settings;
    settings.particles = c.particles == 0 ? 0 : options.particles.value_or(c.particles);
    settings.dt_s = c.dt_s.empty() || options.dt_s.empty() ? c.dt_s : options.dt_s;
    settings.seed = options.seed;
    settings.threads = options.threads;
    settings.data_folder = data_folder(options);
    settings.scene_folder = find_scene("town").parent_path();
    return settings;
}

void print_table(const Case& c, const Outcome& outcome, double seconds)
{
    fmt::print("\n{}: {} ({:.1f} s)\n", c.name, c.about, seconds);
    if (!outcome.skipped.empty()) fmt::print("  skipped: {}\n", outcome.skipped);
    if (outcome.checks.empty()) return;
    std::size_t width = 6;
    for (const Check& check : outcome.checks) width = std::max(width, check.metric.size());
    fmt::print("  {:<{}}  {:>11}  {:>11}  {:>9}  {:>9}  pass\n", "metric", width, "measured", "truth",
               "noise", "allowed");
    for (const Check& check : outcome.checks)
        fmt::print("  {:<{}}  {:>11.5g}  {}{:>10.5g}  {:>9.2g}  {:>9.2g}  {}\n", check.metric, width,
                   check.measured, check.side == validation::Side::above ? '<' : ' ', check.truth,
                   check.noise, check.allowed, check.pass() ? "yes" : "NO");
    std::fflush(stdout);
}

Json json_of(const Case& c, const Settings& settings, const Outcome& outcome, double seconds)
{
    Json checks = Json::array();
    for (const Check& check : outcome.checks)
        checks.push_back({{"metric", check.metric},
                          {"measured", check.measured},
                          {"truth", check.truth},
                          {"noise", check.noise},
                          {"allowed", check.allowed},
                          {"only_above", check.side == validation::Side::above},
                          {"pass", check.pass()}});
    return {{"case", c.name},         {"about", c.about},   {"particles", settings.particles},
            {"dt_s", settings.dt_s},  {"seconds", seconds}, {"skipped", outcome.skipped},
            {"pass", outcome.pass()}, {"checks", checks}};
}

}  // namespace

int validate(const ValidateOptions& options)
{
    const auto chosen = chosen_cases(options.cases);
    std::vector<Settings> settings;
    for (const Case* c : chosen) settings.push_back(settings_of(*c, options));
    Json all = Json::array();
    std::size_t checks = 0, failed = 0, skipped = 0;
    for (std::size_t i = 0; i < chosen.size(); ++i)
    {
        const bool terminal = isatty(STDERR_FILENO) != 0;
        if (terminal) fmt::print(stderr, "\r{} of {}: {} ...\033[K", i + 1, chosen.size(), chosen[i]->name);
        const auto start = std::chrono::steady_clock::now();
        const Outcome outcome = chosen[i]->run(settings[i]);
        const double seconds =
            std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
        if (terminal) fmt::print(stderr, "\r\033[K");
        checks += outcome.checks.size();
        skipped += outcome.skipped.empty() ? 0 : 1;
        failed += static_cast<std::size_t>(std::count_if(outcome.checks.begin(), outcome.checks.end(),
                                                         [](const Check& check) { return !check.pass(); }));
        if (options.json)
            all.push_back(json_of(*chosen[i], settings[i], outcome, seconds));
        else
            print_table(*chosen[i], outcome, seconds);
    }
    if (options.json)
        fmt::print("{}\n", Json{{"cases", all}, {"pass", failed == 0}}.dump(2));
    else
        fmt::print("\n{} checks in {} case(s), {} failed{}\n", checks, chosen.size(), failed,
                   skipped > 0 ? fmt::format(", {} case(s) skipped", skipped) : "");
    return failed == 0 ? kOk : kCheckFailed;
}

}  // namespace spindrift::app
