// SPDX-License-Identifier: MIT
#include "core/tone.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using spindrift::Tone;
using spindrift::tone_mapped;
using spindrift::ToneCurve;
using spindrift::Vec3d;

double grey_through(double light, const Tone<double>& tone)
{
    const Vec3d shown = tone_mapped(Vec3d{light, light, light}, tone);
    EXPECT_NEAR(shown.x, shown.y, 1e-3);  // the published matrices keep grey so far
    EXPECT_NEAR(shown.x, shown.z, 1e-3);
    return shown.y;
}

constexpr ToneCurve kCurves[] = {ToneCurve::linear,  ToneCurve::reinhard,   ToneCurve::aces,  ToneCurve::agx,
                                 ToneCurve::neutral, ToneCurve::calibrated, ToneCurve::legacy};

TEST(ToneCurves, RiseFromBlackAndStayInTheDisplay)
{
    for (const ToneCurve curve : kCurves)
    {
        const Tone<double> tone{curve, 4, 1, 0};
        EXPECT_NEAR(grey_through(0, tone), 0, 1e-5);
        double last = 0;
        for (double light = 1e-4; light < 1e6; light *= 1.1)
        {
            const double shown = grey_through(light, tone);
            EXPECT_GE(shown, last - 1e-12) << static_cast<int>(curve) << ' ' << light;
            EXPECT_LE(shown, 1);
            last = shown;
        }
        EXPECT_GT(last, 0.97) << static_cast<int>(curve);
    }
}

// Reinhard et al. 2002, eq. 3 and 4: without a white point L / (1 + L); the white point itself is white.
TEST(ToneCurves, ReinhardAtItsPublishedPoints)
{
    const Tone<double> tone{ToneCurve::reinhard, 4, 1, 0};
    EXPECT_NEAR(grey_through(4, tone), 1, 1e-12);
    EXPECT_NEAR(grey_through(1, tone), 0.5 * (1 + 1.0 / 16), 1e-12);
    EXPECT_NEAR(grey_through(1, {ToneCurve::reinhard, 1e9, 1, 0}), 0.5, 1e-9);
    const Vec3d shown = tone_mapped(Vec3d{0.4, 0.2, 0.1}, tone);
    EXPECT_NEAR(shown.x / shown.y, 2, 1e-12) << "hue is kept";
}

// The RRT and the 48-nit ODT show 0.18 as 4.8 cd/m2, a tenth of white; the fit is good to a percent of white.
// At infinity the fit's quotient is 1 / 0.983729, beyond white.
TEST(ToneCurves, AcesAtItsPublishedPoints)
{
    const Tone<double> tone{ToneCurve::aces, 4, 1, 0};
    EXPECT_NEAR(grey_through(0.18, tone), 0.10, 0.01);
    EXPECT_EQ(grey_through(1e5, tone), 1);
}

// AgX puts 0.18, 10 of its 16.5 stops, to the middle of the display's code values; its ends are the ends.
TEST(ToneCurves, AgxAtItsPublishedPoints)
{
    EXPECT_NEAR(spindrift::agx_contrast(10.0 / 16.5), 0.5, 0.015);
    EXPECT_NEAR(spindrift::agx_contrast(0.0), 0, 3e-3);
    EXPECT_NEAR(spindrift::agx_contrast(1.0), 1, 5e-3);
    const Tone<double> tone{ToneCurve::agx, 4, 1, 0};
    EXPECT_NEAR(std::pow(grey_through(0.18, tone), 1 / 2.2), spindrift::agx_contrast(10.0 / 16.5), 1e-3);
}

// Khronos PBR Neutral: 1:1 but for the 4 % of a dielectric from 0.08 to 0.8; 6.25 x² below; invertible above.
TEST(ToneCurves, NeutralAtItsPublishedPoints)
{
    const Tone<double> tone{ToneCurve::neutral, 4, 1, 0};
    for (const double light : {0.08, 0.2, 0.5, 0.799})
        EXPECT_NEAR(grey_through(light, tone), light - 0.04, 1e-12);
    for (const double light : {0.01, 0.04, 0.0799})
        EXPECT_NEAR(grey_through(light, tone), 6.25 * light * light, 1e-12);
    for (const double light : {0.9, 2.0, 50.0})
    {
        const double shown = grey_through(light, tone);
        const double above = 0.24 * 0.24 / (1 - shown) - 0.24;  // inverse of the compression
        EXPECT_NEAR(above + 0.76 + 0.04, light, 1e-9 * light);
    }
    const Vec3d base{0.7, 0.3, 0.2};
    const Vec3d shown = tone_mapped(base, tone);
    EXPECT_NEAR(shown.x, base.x - 0.04, 1e-12);
    EXPECT_NEAR(shown.z, base.z - 0.04, 1e-12);
}

// The report's formula gives 0.55 for exposure 1 and largest luminance 10, whatever the pixel.
TEST(ToneCurves, LegacyIsAConstantGain)
{
    EXPECT_NEAR(spindrift::legacy_gain(1, 10), 0.55, 1e-12);
    const Tone<double> tone{ToneCurve::legacy, 10, spindrift::legacy_gain(1, 10), 0};
    EXPECT_NEAR(grey_through(0.3, tone) / 0.3, grey_through(1.2, tone) / 1.2, 1e-12);
}

TEST(ToneCurves, CalibratedShowsALuminanceAsItself)
{
    const Tone<double> tone = spindrift::calibrated_tone(100, 250, 0.5);
    for (const double light : {0.01, 0.5, 2.4})
    {
        const double given_off = 0.5 + (250 - 0.5) * grey_through(light, tone);
        EXPECT_NEAR(given_off, 100 * light, 1e-9);
    }
    EXPECT_EQ(grey_through(3, tone), 1);
    EXPECT_EQ(grey_through(0.001, tone), 0);
}

// IEC 61966-2-1: code values of the standard's own formula at its joints and of known greys.
TEST(Srgb, IsExactBothWays)
{
    EXPECT_NEAR(spindrift::srgb_encoded(0.0031308), 0.04045, 2e-6);
    EXPECT_NEAR(spindrift::srgb_encoded(0.18), 0.461356129500442, 1e-12);
    EXPECT_NEAR(spindrift::srgb_encoded(1.0), 1, 1e-12);
    EXPECT_EQ(spindrift::srgb_encoded(0.0), 0);
    for (int level = 0; level < 256; ++level)
        EXPECT_NEAR(spindrift::srgb_encoded(spindrift::srgb_decoded(level / 255.0)), level / 255.0, 1e-7);
}

}  // namespace
