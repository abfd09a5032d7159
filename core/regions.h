// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/encounter.h"
#include "core/vec.h"
#include "core/world.h"

namespace spindrift
{

/// A moving point without ownership: on its keys, or where somebody put it.
struct AnchorView
{
    const Anchor::Key* keys = nullptr;
    std::uint32_t count = 0;  ///< at least 1
    bool placed = false;
    Vec3f place{};  ///< if placed

    SPINDRIFT_HD Vec3f at(double time_s) const
    {
        if (placed) return place;
        std::uint32_t after = 0;  // the first key that is later
        std::uint32_t end = count;
        while (after < end)
        {
            const std::uint32_t middle = after + (end - after) / 2;
            if (time_s < keys[middle].time_s)
                end = middle;
            else
                after = middle + 1;
        }
        if (after == 0) return keys[0].position_m;
        if (after == count) return keys[count - 1].position_m;
        const Anchor::Key& a = keys[after - 1];
        const Anchor::Key& b = keys[after];
        const double t = (time_s - a.time_s) / (b.time_s - a.time_s);
        return {between(a.position_m.x, b.position_m.x, t), between(a.position_m.y, b.position_m.y, t),
                between(a.position_m.z, b.position_m.z, t)};
    }

  private:
    SPINDRIFT_HD static float between(float a, float b, double t)
    {
        return static_cast<float>(static_cast<double>(a) +
                                  t * (static_cast<double>(b) - static_cast<double>(a)));
    }
};

/// Where the flakes of each emitter live: the box of a sky, else the domain. Plain numbers and addresses.
struct RegionPlacer
{
    const Emitter* emitters = nullptr;
    std::size_t count = 0;
    const AnchorView* anchors = nullptr;
    Vec3f size_m{};  ///< of the domain

    /// Fills regions[0 … max(count, 1)).
    SPINDRIFT_HD void operator()(double time_s, Region* regions) const
    {
        regions[0] = {{0, 0, 0}, size_m, false};
        for (std::size_t e = 0; e < count; ++e) regions[e] = region(emitters[e], time_s);
    }

  private:
    SPINDRIFT_HD Region region(const Emitter& emitter, double time_s) const
    {
        if (emitter.shape != EmitterShape::sky) return {{0, 0, 0}, size_m, false};
        const Vec3f centre = emitter.anchor < 0 ? emitter.a : anchors[emitter.anchor].at(time_s);
        const Vec3f half = emitter.b * 0.5F;
        return {centre - half, centre + half, true};
    }
};

}  // namespace spindrift
