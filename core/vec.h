// SPDX-License-Identifier: MIT
#pragma once

#include "core/platform.h"

namespace spindrift
{

/// Three components of one quantity; R is float, double or a SIMD pack of float.
template <class R>
struct Vec3
{
    R x, y, z;
};

using Vec3f = Vec3<float>;
using Vec3d = Vec3<double>;

template <class R>
SPINDRIFT_HD Vec3<R> operator+(const Vec3<R>& a, const Vec3<R>& b)
{
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class R>
SPINDRIFT_HD Vec3<R> operator-(const Vec3<R>& a, const Vec3<R>& b)
{
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}

template <class R>
SPINDRIFT_HD Vec3<R> operator*(const Vec3<R>& a, const R& s)
{
    return {a.x * s, a.y * s, a.z * s};
}

template <class R>
SPINDRIFT_HD R dot(const Vec3<R>& a, const Vec3<R>& b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

template <class R>
SPINDRIFT_HD Vec3<R> cross(const Vec3<R>& a, const Vec3<R>& b)
{
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

}  // namespace spindrift
