// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/math.h"
#include "core/number.h"
#include "core/philox.h"
#include "core/world.h"

namespace spindrift
{

/// A wave of the stream function of gusts: amplitude sin(2 pi (x along_x + y along_y + phase - t rate)).
struct GustWave
{
    float along_x = 0, along_y = 0;  ///< turns per metre
    float amplitude = 0;             ///< m2/s
    double phase = 0, rate = 0;      ///< turns, turns per second
};

/// Frozen, horizontal gusts, the same for a seed: waves from the stated length down to an eighth of it with
/// the energy of k^(-5/3), in random directions, carried along with a constant velocity (Taylor's
/// hypothesis). Their velocity (d/dy, -d/dx) psi has no divergence. docs/physics.md "Gusts".
struct GustPattern
{
    static constexpr int kWaves = 16;
    GustWave waves[kWaves];

    /// psi in m2/s.
    SPINDRIFT_HD float stream(double x_m, double y_m, double time_s) const
    {
        float sum = 0;
        for (const GustWave& wave : waves)
        {
            const double turns = x_m * static_cast<double>(wave.along_x) +
                                 y_m * static_cast<double>(wave.along_y) + (wave.phase - time_s * wave.rate);
            float sine = 0, cosine = 0;
            sincos_turns(static_cast<float>(turns - floor(turns)), sine, cosine);
            sum = fma(wave.amplitude, sine, sum);
        }
        return sum;
    }
};

/// The mean square of each horizontal component is speed_m_s squared. Host only.
inline GustPattern gust_pattern(const GustSettings& gusts)
{
    constexpr double kTurn = 6.28318530717958647693;
    GustPattern pattern;
    double energy[GustPattern::kWaves], total = 0;
    for (int i = 0; i < GustPattern::kWaves; ++i)
    {
        // k^(-5/3) dk over steps of equal ratio: k^(-2/3)
        energy[i] = exp2(-2.0 / 3.0 * (3.0 * i / (GustPattern::kWaves - 1)));
        total += energy[i];
    }
    for (int i = 0; i < GustPattern::kWaves; ++i)
    {
        const auto words = philox<std::uint32_t>(gusts.seed, {static_cast<std::uint32_t>(i), 0, 0, 0});
        const double per_m = exp2(3.0 * i / (GustPattern::kWaves - 1)) / static_cast<double>(gusts.length_m);
        double sine = 0, cosine = 0;
        sincos_turns(uniform<double>(words.x0), sine, cosine);
        GustWave& wave = pattern.waves[i];
        wave.along_x = static_cast<float>(per_m * cosine);
        wave.along_y = static_cast<float>(per_m * sine);
        // a wave of amplitude A gives both components together the mean square (A k)^2 / 2
        wave.amplitude = static_cast<float>(2 * static_cast<double>(gusts.speed_m_s) *
                                            sqrt(energy[i] / total) / (kTurn * per_m));
        wave.phase = uniform<double>(words.x1);
        wave.rate = static_cast<double>(wave.along_x) * static_cast<double>(gusts.carried_m_s.x) +
                    static_cast<double>(wave.along_y) * static_cast<double>(gusts.carried_m_s.y);
    }
    return pattern;
}

}  // namespace spindrift
