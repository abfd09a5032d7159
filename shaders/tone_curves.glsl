// SPDX-License-Identifier: MIT
// The tone curves of core/tone.h, with their sources; TONE says which one. Matrices are transposed here: GLSL counts by columns.
vec3 tone_reinhard(vec3 c)
{
    float y = max(dot(c, vec3(0.2126, 0.7152, 0.0722)), 1e-30);
    return c * ((1.0 + y / (tone.x * tone.x)) / (1.0 + y));
}

vec3 tone_aces(vec3 c)
{
    const mat3 in_rows = mat3(0.59719, 0.35458, 0.04823, 0.07600, 0.90834, 0.01566, 0.02840, 0.13383, 0.83777);
    const mat3 out_rows = mat3(1.60475, -0.53108, -0.07367, -0.10208, 1.10813, -0.00605, -0.00327, -0.07276, 1.07602);
    vec3 v = c * in_rows;
    v = (v * (v + 0.0245786) - 0.000090537) / (v * (0.983729 * v + 0.4329510) + 0.238081);
    return v * out_rows;
}

vec3 tone_agx(vec3 c)
{
    const mat3 inset_rows = mat3(0.842479062253094, 0.0784335999999992, 0.0792237451477643,
                                 0.0423282422610123, 0.878468636469772, 0.0791661274605434,
                                 0.0423756549057051, 0.0784336, 0.879142973793104);
    const mat3 outset_rows = mat3(1.19687900512017, -0.0980208811401368, -0.0990297440797205,
                                  -0.0528968517574562, 1.15190312990417, -0.0989611768448433,
                                  -0.0529716355144438, -0.0980434501171241, 1.15107367264116);
    vec3 x = clamp((log2(max(c * inset_rows, 1e-10)) + 12.47393) / (4.026069 + 12.47393), 0.0, 1.0);
    vec3 v = -0.00232 + x * (0.1191 + x * (0.4298 + x * (-6.868 + x * (31.96 + x * (-40.14 + x * 15.5)))));
    return pow(max(v * outset_rows, 0.0), vec3(2.2));
}

vec3 tone_neutral(vec3 c)
{
    const float start = 0.8 - 0.04;
    float least = min(c.x, min(c.y, c.z));
    c -= least < 0.08 ? least - 6.25 * least * least : 0.04;
    float peak = max(c.x, max(c.y, c.z));
    if (peak < start) return c;
    float rest = 1.0 - start;
    float new_peak = 1.0 - rest * rest / (peak - start + rest);
    return mix(vec3(new_peak), c * (new_peak / peak), 1.0 / (0.15 * (peak - new_peak) + 1.0));
}

vec3 tone_affine(vec3 c)
{
    return c * tone.y + tone.z;
}

vec3 tone_mapped(vec3 c)
{
    return clamp(TONE(c), 0.0, 1.0);
}
