// SPDX-License-Identifier: MIT
#include "scene/inflow_profile.h"

#include <cmath>

#include "core/turbulence.h"

namespace spindrift::scene
{

namespace
{

Vec3d direction_from(double degrees)
{
    const double from = degrees * (3.14159265358979323846 / 180.0);
    return {-std::sin(from), -std::cos(from), 0};
}

}  // namespace

InflowProfile::InflowProfile(const WindSettings& settings)
    : settings_(settings), to_(direction_from(settings.from_direction_deg))
{
    for (const WindLevel& level : settings.levels)
        levels_.push_back(direction_from(level.from_direction_deg) * level.speed_m_s);
    const bool measured = settings.profile == InflowKind::measured;
    const double speed = measured ? settings.levels.front().speed_m_s : settings.speed_m_s;
    const double height = measured ? settings.levels.front().height_m : settings.reference_height_m;
    friction_m_s_ = settings.friction_velocity_m_s > 0 ? settings.friction_velocity_m_s
                                                       : kVonKarman * speed / logarithm(height);
}

double InflowProfile::logarithm(double height_m) const
{
    return std::log((height_m + settings_.roughness_m) / settings_.roughness_m);
}

Vec3d InflowProfile::at(double height_m) const
{
    if (!(height_m > 0)) return {0, 0, 0};
    switch (settings_.profile)
    {
        case InflowKind::logarithmic:
            return to_ * (friction_m_s_ / kVonKarman * logarithm(height_m));
        case InflowKind::power:
            return to_ * (settings_.speed_m_s *
                          std::pow(height_m / settings_.reference_height_m, settings_.exponent));
        case InflowKind::measured:
            return measured(height_m);
    }
    return {0, 0, 0};
}

/// Linear in ln(z + z0) between levels, logarithmic below the lowest, constant above the highest.
Vec3d InflowProfile::measured(double height_m) const
{
    const std::vector<WindLevel>& levels = settings_.levels;
    if (height_m <= levels.front().height_m)
        return levels_.front() * (logarithm(height_m) / logarithm(levels.front().height_m));
    for (std::size_t i = 1; i < levels.size(); ++i)
        if (height_m <= levels[i].height_m)
        {
            const double low = logarithm(levels[i - 1].height_m), high = logarithm(levels[i].height_m);
            const double share = (logarithm(height_m) - low) / (high - low);
            return levels_[i - 1] * (1 - share) + levels_[i] * share;
        }
    return levels_.back();
}

}  // namespace spindrift::scene
