// SPDX-License-Identifier: MIT
// What of exposed light is bright (core/bloom.h).
vec3 bright_part(vec3 c)
{
#ifdef REPORT
    float most = max(c.x, max(c.y, c.z));
    c *= min(most, bright.z) / max(most, 1e-10);
    return clamp((c - bright.x) / max(1.0 - bright.x, 1e-3), vec3(0.0), c);
#else
    float given = max(c.x, max(c.y, c.z));
    float value = min(given, bright.z);
    float soft = clamp(value - bright.x + bright.y, 0.0, 2.0 * bright.y);
    float above = max(soft * soft / max(4.0 * bright.y, 1e-10), value - bright.x);
    return c * (max(above, 0.0) / max(given, 1e-10));
#endif
}

// Whether light as rendered may be bright at all; NaN beside a bright channel does not hide it.
bool sets_in(vec3 c)
{
    return any(greaterThan(exposure * c, vec3(bright.w)));
}
