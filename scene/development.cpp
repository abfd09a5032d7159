// SPDX-License-Identifier: MIT
#include "scene/development.h"

#include "core/light.h"

namespace spindrift::scene
{

Tone<double> tone_of(const Scene& scene)
{
    const DisplaySettings& display = scene.display;
    if (display.tone == ToneCurve::calibrated)
        return calibrated_tone(display.unit_cd_m2, display.white_cd_m2, display.black_cd_m2);
    Tone<double> tone{display.tone, display.white, 1, 0};
    if (display.tone == ToneCurve::legacy) tone.scale = legacy_gain(scene.render.exposure, display.white);
    return tone;
}

Bright<double> bright_of(const BloomSettings& bloom)
{
    return {bloom.threshold, bloom.knee, bloom.ceiling};
}

double bloom_sigma_px(const BloomSettings& bloom, int height_px)
{
    constexpr double kHeight = 720;  // for which sigma_px is given
    return bloom.sigma_px * height_px / kHeight;
}

PixelLuminance pixel_luminance(const DisplaySettings& display, const float* light, const unsigned char* shown)
{
    const Vec3d sent = contained(Vec3d{double{light[0]}, double{light[1]}, double{light[2]}});
    const auto given_off = [&](int i) { return srgb_decoded(shown[i] / 255.0); };
    const Vec3d seen{given_off(0), given_off(1), given_off(2)};
    return {display.unit_cd_m2 * luminance(sent),
            display.black_cd_m2 + (display.white_cd_m2 - display.black_cd_m2) * luminance(seen)};
}

}  // namespace spindrift::scene
