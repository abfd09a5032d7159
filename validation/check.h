// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace spindrift::validation
{

/// Which deviations from the truth count against a check.
enum class Side
{
    both,
    above,  ///< a measured value below the truth is as good as the truth itself
};

/// One number that was measured, beside what it should be.
struct Check
{
    std::string metric;
    double measured = 0;
    double truth = 0;
    double noise = 0;    ///< one standard deviation of `measured` by sampling alone; 0: there is none
    double allowed = 0;  ///< largest deviation that passes
    Side side = Side::both;

    bool pass() const
    {
        const double off = measured - truth;
        return std::isfinite(measured) && (side == Side::above ? off : std::abs(off)) <= allowed;
    }
};

/// Within `sigmas` standard deviations of sampling, and what else the truth itself is uncertain by.
inline Check sampled(std::string metric, double measured, double truth, double noise, double sigmas,
                     double truth_uncertain_by = 0)
{
    return {std::move(metric), measured, truth, noise, sigmas * noise + truth_uncertain_by, Side::both};
}

inline Check at_most(std::string metric, double measured, double bound, double noise = 0)
{
    return {std::move(metric), measured, bound, noise, 0, Side::above};
}

struct Outcome
{
    std::vector<Check> checks;
    std::string skipped;  ///< why nothing was checked; empty: something was

    bool pass() const
    {
        for (const Check& check : checks)
            if (!check.pass()) return false;
        return true;
    }
};

/// What a case is run with.
struct Settings
{
    std::uint64_t particles = 0;
    std::vector<double> dt_s;
    std::uint64_t seed = 1;
    int threads = 0;                     ///< 0: one per core
    std::filesystem::path data_folder;   ///< field data; empty: none
    std::filesystem::path scene_folder;  ///< shipped scenes
};

/// A case of `spindrift validate`. It drives the CPU backend, or the solver that scenes use, never a copy of
/// them.
struct Case
{
    std::string name;
    std::string about;         ///< one line; docs/validation.md has formulas and sources
    std::uint64_t particles;   ///< unless told otherwise; 0: it has none
    std::vector<double> dt_s;  ///< likewise; empty: it has none
    Outcome (*run)(const Settings&);
};

/// In the order in which they are run.
const std::vector<Case>& cases();

}  // namespace spindrift::validation
