// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/number.h"
#include "core/vec.h"
#include "core/view.h"

namespace spindrift
{

/// What of the space in front of a View is drawn: the frustum from near to far, widened by the guard band.
struct Frustum
{
    Vec3f eye{}, right{}, up{}, forward{};
    float near_m = 0, far_m = 0;
    float slope_x = 0, slope_y = 0;  ///< largest |right| and |up| per metre of depth
    float buckets_per_m = 0;         ///< linear depth keys: buckets over far_m
    std::uint32_t last_bucket = 0;
    int key_bits = 32;
};

/// `key_bits`: 32 (exact order) or fewer (linear buckets of distance between 0 and the far plane), at
/// least 1.
inline Frustum frustum(const View& view, int key_bits)
{
    Frustum f;
    f.eye = view.eye, f.right = view.right, f.up = view.up, f.forward = view.forward;
    f.near_m = view.near_m, f.far_m = view.far_m;
    const auto width = static_cast<float>(view.width_px);
    const auto height = static_cast<float>(view.height_px);
    const float per_pixel = 2 * view.tan_half_fov_y / height;
    f.slope_y = (0.5F * height + view.guard_px) * per_pixel;
    f.slope_x = (0.5F * width + view.guard_px) * per_pixel;
    f.key_bits = key_bits;
    if (key_bits < 32)
    {
        f.last_bucket = (1U << key_bits) - 1U;
        // the corners of the far plane are farther than far_m
        const float farthest = view.far_m * sqrt(1 + f.slope_x * f.slope_x + f.slope_y * f.slope_y);
        f.buckets_per_m = static_cast<float>(f.last_bucket) / farthest;
    }
    return f;
}

template <class R>
SPINDRIFT_HD Vec3<R> from_eye(const Frustum& f, const Vec3<R>& x)
{
    return {x.x - R(f.eye.x), x.y - R(f.eye.y), x.z - R(f.eye.z)};
}

/// Whether the point `d` (relative to the eye) is to be drawn.
template <class R>
SPINDRIFT_HD MaskOf<R> in_view(const Frustum& f, const Vec3<R>& d)
{
    const R depth = fma(d.x, R(f.forward.x), fma(d.y, R(f.forward.y), d.z * R(f.forward.z)));
    const R side = fma(d.x, R(f.right.x), fma(d.y, R(f.right.y), d.z * R(f.right.z)));
    const R height = fma(d.x, R(f.up.x), fma(d.y, R(f.up.y), d.z * R(f.up.z)));
    return depth >= R(f.near_m) && depth <= R(f.far_m) && abs(side) <= depth * R(f.slope_x) &&
           abs(height) <= depth * R(f.slope_y);
}

/// Key whose ascending order is far to near by distance to the eye. 32 bits: the complement of the bits of
/// the squared distance, which order as the distances do; fewer: linear buckets.
template <class R>
SPINDRIFT_HD UIntOf<R> depth_key(const Frustum& f, const Vec3<R>& d)
{
    using UInt = UIntOf<R>;
    const R square = fma(d.x, d.x, fma(d.y, d.y, d.z * d.z));
    if (f.key_bits >= 32) return bits(square) ^ UInt(0xFFFFFFFFU);
    const UInt last = UInt(f.last_bucket);
    const R bucket = min(sqrt(square) * R(f.buckets_per_m), to_real<R>(as_int(last)));
    return last - as_uint(truncate_to_int(bucket));
}

}  // namespace spindrift
