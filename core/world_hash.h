// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "core/philox.h"
#include "core/vec.h"
#include "core/world.h"

namespace spindrift
{

namespace detail
{

/// Takes values one by one, never whole structures: their padding has no value.
class WorldHasher
{
  public:
    template <class T>
    void add(T value)
    {
        static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
        std::uint64_t word = 0;
        std::memcpy(&word, &value, sizeof value);
        value_ = mix64((value_ + 0x9E3779B97F4A7C15U) ^ word);
    }
    template <class... T>
    void all(T... values)
    {
        (add(values), ...);
    }
    void add(const Vec3f& v) { all(v.x, v.y, v.z); }
    void add(const Surface& s) { all(s.contact, s.restitution); }
    void bytes(const void* data, std::size_t count)
    {
        const auto* p = static_cast<const unsigned char*>(data);
        for (; count >= 8; count -= 8, p += 8)
        {
            std::uint64_t word = 0;
            std::memcpy(&word, p, 8);
            add(word);
        }
        for (; count > 0; --count, ++p) add(*p);
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0;
};

inline void add(WorldHasher& h, const Emitter& e)
{
    h.add(e.shape);
    h.add(e.a), h.add(e.b), h.add(e.c);
    h.all(e.radius_m, e.lift_m_s, e.rate_per_s, e.burst);
    h.add(e.velocity_m_s);
    h.all(e.at_rest_in_air, e.anchor);
}

inline void add(WorldHasher& h, const Wind& w)
{
    h.all(w.kind, w.turbulent);
    h.add(w.uniform_m_s);
    h.all(w.friction_velocity_m_s, w.roughness_m, w.ground_m, w.boundary_layer_m, w.to_x, w.to_y, w.nx, w.ny,
          w.nz);
    h.add(w.origin_m), h.add(w.cell_m);
    static_assert(sizeof(WindCell) == 16 * sizeof(float), "no padding");
    h.add(w.cells.size());
    h.bytes(w.cells.data(), w.cells.size() * sizeof(WindCell));
}

inline void add(WorldHasher& h, const VoxelGrid& v)
{
    h.all(v.nx, v.ny, v.nz);
    h.add(v.origin_m);
    h.all(v.cell_m, v.clearance.size(), v.surface.size());
    h.bytes(v.clearance.data(), v.clearance.size());
    h.bytes(v.surface.data(), v.surface.size());
}

}  // namespace detail

/// Of every value of a World that its flakes depend on: a snapshot fits only the World that it was made in.
/// Host only.
inline std::uint64_t world_hash(const World& w)
{
    detail::WorldHasher h;
    h.add(w.size_m);
    h.all(w.on_leave, w.step_s, w.seed, w.capacity);
    h.all(w.snow.crystal, w.snow.spectrum, w.snow.rate_mm_h, w.snow.fall_speed_spread_m_s,
          w.snow.fall_speed_m_s, w.snow.weight, w.snow.inertia, w.snow.crossing);
    add(h, w.wind);
    h.add(w.emitters.size());
    for (const Emitter& e : w.emitters) add(h, e);
    h.all(w.grains.shape, w.grains.scale_m);
    h.all(w.has_ground, w.ground_m);
    h.add(w.ground);
    add(h, w.voxels);
    h.add(w.surfaces.size());
    for (const Surface& s : w.surfaces) h.add(s);
    for (const Anchor& a : w.anchors)
    {
        h.add(a.keys.size());
        for (const Anchor::Key& k : a.keys)
        {
            h.add(k.time_s);
            h.add(k.position_m);
        }
    }
    return h.value();
}

}  // namespace spindrift
