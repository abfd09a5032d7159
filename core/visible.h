// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/depth_key.h"
#include "core/flake.h"
#include "core/number.h"
#include "core/vec.h"

namespace spindrift
{

/// Which flakes of a view are drawn, and their depth keys. R: float or a SIMD pack of float.
template <class R>
struct VisibleFlakes
{
    Frustum frustum;
    FlakeView flakes;

    /// Of the flakes from slot i on, relative to the eye.
    SPINDRIFT_HD Vec3<R> offset(std::size_t i) const
    {
        return from_eye(frustum,
                        Vec3<R>{load<R>(flakes.x + i), load<R>(flakes.y + i), load<R>(flakes.z + i)});
    }
    SPINDRIFT_HD MaskOf<R> sees(std::size_t i, const Vec3<R>& offset) const
    {
        using UInt = UIntOf<R>;
        const auto alive = (load<UInt>(flakes.state + i) & UInt(0xFFU)) == UInt(0U);
        return alive && in_view(frustum, offset);
    }
    SPINDRIFT_HD UIntOf<R> key(const Vec3<R>& offset) const { return depth_key(frustum, offset); }
};

/// An element of a draw list.
SPINDRIFT_HD std::uint64_t draw_list_pair(std::uint32_t key, std::size_t slot)
{
    return static_cast<std::uint64_t>(key) << 32 | slot;
}

}  // namespace spindrift
