// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "core/bloom.h"
#include "core/exposure.h"
#include "core/tone.h"
#include "reference/development.h"
#include "scene/development.h"
#include "tests/gl/darkroom.h"
#include "tests/gl/stage.h"

namespace spindrift::gl
{
namespace
{

/// From 1e-5 to the largest half float, in twelve colours.
Darkroom sweep()
{
    constexpr int kSteps = 400;
    Darkroom room(kSteps, 12);
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < kSteps; ++x)
        {
            const auto light = static_cast<float>(1e-5 * std::pow(65504 / 1e-5, x / (kSteps - 1.0)));
            const float parts[] = {1, 0.5F, 0.1F, 0};
            room.set(x, y, light, light * parts[y % 4], light * parts[y / 3]);
        }
    return room;
}

struct ToneMapping : testing::TestWithParam<ToneCurve>
{
};

TEST_P(ToneMapping, ShowsWhatTheFormulaSays)
{
    Darkroom room = sweep();
    room.scene.display.tone = GetParam();
    room.scene.display.unit_cd_m2 = 100;
    room.scene.display.white_cd_m2 = 250;
    room.scene.display.black_cd_m2 = 0.3;
    const bool calibrated = GetParam() == ToneCurve::calibrated;
    room.scene.render.exposure = calibrated ? 1 : 1.7;
    const Tone<double> tone = scene::tone_of(room.scene);
    const image::Image shown = room.shown();
    for (int y = 0; y < room.light.height; ++y)
        for (int x = 0; x < room.light.width; ++x)
        {
            const float* given = room.light.pixel(x, y);
            const Vec3d light{double{given[0]}, double{given[1]}, double{given[2]}};
            const Vec3d wanted = tone_mapped(light * room.scene.render.exposure, tone);
            const float* drawn = shown.pixel(x, y);
            ASSERT_NEAR(drawn[0], srgb_encoded(wanted.x), 5e-4) << x << ' ' << y << ' ' << light.x;
            ASSERT_NEAR(drawn[1], srgb_encoded(wanted.y), 5e-4) << x << ' ' << y << ' ' << light.x;
            ASSERT_NEAR(drawn[2], srgb_encoded(wanted.z), 5e-4) << x << ' ' << y << ' ' << light.x;
        }
}

INSTANTIATE_TEST_SUITE_P(Curves, ToneMapping,
                         testing::Values(ToneCurve::linear, ToneCurve::reinhard, ToneCurve::aces,
                                         ToneCurve::agx, ToneCurve::neutral, ToneCurve::calibrated,
                                         ToneCurve::legacy));

TEST(Srgb8, IsTheNearestLevel)
{
    Darkroom room(4096, 1);
    for (int x = 0; x < 4096; ++x)
    {
        const float light = static_cast<float>(x) / 4095;
        room.set(x, 0, light, light * light, 0);
    }
    const image::Image8 shown = room.shown8();
    for (int x = 0; x < 4096 * 3; ++x)
    {
        const double exact = 255 * srgb_encoded(double{room.light.pixel(x / 3, 0)[x % 3]});
        ASSERT_NEAR(shown.rgb[static_cast<std::size_t>(x)], exact, 0.51) << x;
    }
}

TEST(Dither, KeepsTheMeanAndStaysWithinALevel)
{
    Darkroom room(128, 128);
    for (const double level : {0.0, 20.25, 100.5, 200.75, 255.0})
    {
        room.fill(static_cast<float>(srgb_decoded(level / 255)));
        room.scene.display.dither = true;
        const image::Image8 shown = room.shown8();
        double sum = 0;
        for (const unsigned char value : shown.rgb)
        {
            ASSERT_NEAR(value, level, 1);
            sum += value;
        }
        EXPECT_NEAR(sum / static_cast<double>(shown.rgb.size()), level, 0.03);
        room.scene.display.dither = false;
        for (const unsigned char value : room.shown8().rgb) ASSERT_NEAR(value, level, 0.51);
    }
}

TEST(AutomaticExposure, IsThatOfTheReference)
{
    Darkroom room(320, 200);
    for (int y = 0; y < 200; ++y)
        for (int x = 0; x < 320; ++x)
            room.set(x, y, 0.01F * static_cast<float>(x % 40), 0.02F, y < 60 ? 30.0F : 0.4F);
    room.scene.render.auto_exposure = true;
    room.scene.render.grey = 0.2;
    room.shown();
    EXPECT_NEAR(room.exposure / reference::exposure_of(room.light, room.scene.render), 1, 0.02)
        << "one pixel in sixteen is looked at";
    room.fill(0.36F);
    room.shown();
    EXPECT_NEAR(room.exposure, 0.2 / (0.36 + kDarkest), 1e-4);
    room.fill(std::nanf(""));
    room.shown();
    EXPECT_NEAR(room.exposure, 0.2 / kDarkest, 1);
}

TEST(PixelLuminance, IsInCandelas)
{
    scene::DisplaySettings display;
    display.unit_cd_m2 = 100;
    display.white_cd_m2 = 250;
    display.black_cd_m2 = 0.5;
    const float light[] = {2, 2, 2, 1};
    const unsigned char white[] = {255, 255, 255}, black[] = {0, 0, 0}, grey[] = {128, 128, 128};
    EXPECT_NEAR(scene::pixel_luminance(display, light, white).scene_cd_m2, 200, 1e-9);
    EXPECT_NEAR(scene::pixel_luminance(display, light, white).display_cd_m2, 250, 1e-9);
    EXPECT_NEAR(scene::pixel_luminance(display, light, black).display_cd_m2, 0.5, 1e-9);
    EXPECT_NEAR(scene::pixel_luminance(display, light, grey).display_cd_m2, 0.5 + 249.5 * 0.2158605, 1e-4);
}

}  // namespace
}  // namespace spindrift::gl
