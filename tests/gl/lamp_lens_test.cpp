// SPDX-License-Identifier: MIT
#include "gl/lamp_lens.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace spindrift::gl
{
namespace
{

constexpr CasterBox kBox{{2, 3, 0}, {12, 23, 8}};

Lamp<float> sun()
{
    Lamp<float> lamp;
    lamp.kind = LampKind::directional;
    lamp.direction = {0.6F, 0, -0.8F};
    return lamp;
}

Lamp<float> spot()
{
    Lamp<float> lamp;
    lamp.kind = LampKind::spot;
    lamp.position_m = {7, 13, 20};
    lamp.direction = {0, 0, -1};
    lamp.cos_outer = std::cos(1.0F);
    return lamp;
}

TEST(LampLens, HoldsAllOfItsBox)
{
    for (const Lamp<float>& lamp : {sun(), spot()})
        for (int i = 0; i < 8; ++i)
        {
            const Vec3f corner{i & 1 ? 12.0F : 2.0F, i & 2 ? 23.0F : 3.0F, i & 4 ? 8.0F : 0.0F};
            const SeenByLamp<float> at = seen_by(map_lens(lamp, kBox, 64), corner);
            for (const float along : {at.u, at.v, at.depth / at.width})
            {
                EXPECT_GE(along, -1e-5F) << i;
                EXPECT_LE(along, 1 + 1e-5F) << i;
            }
        }
}

TEST(LampLens, OfASpotSeesNothingBehindIt)
{
    EXPECT_LT(seen_by(map_lens(spot(), kBox, 64), Vec3f{7, 13, 21}).u, 0);
}

TEST(LampLens, DepthGrowsAlongTheLight)
{
    for (const Lamp<float>& lamp : {sun(), spot()})
    {
        const auto depth = [&](float z)
        {
            const SeenByLamp<float> at = seen_by(map_lens(lamp, kBox, 64), Vec3f{7, 13, z});
            return at.depth / at.width;
        };
        EXPECT_LT(depth(7), depth(6));
        EXPECT_LT(depth(2), depth(1));
    }
}

TEST(LampShadows, AreSharpToATexelAndInterpolateBetween)
{
    // The sun from above: the left half of the map is covered at half depth.
    Lamp<float> lamp = sun();
    lamp.direction = {0, 0, -1};
    LampShadows shadows;
    shadows.lamps = 1;
    shadows.map_px = 16;
    shadows.map[0] = map_lens(lamp, kBox, shadows.map_px);
    std::vector<float> nearest(256);
    for (std::size_t i = 0; i < nearest.size(); ++i) nearest[i] = i % 16 < 8 ? 0.5F : 1.0F;
    shadows.nearest = nearest.data();
    // Where the lens has u: a line across the box.
    int lit = 0, dark = 0, between = 0;
    for (int i = 0; i <= 200; ++i)
    {
        const Vec3f place{2 + 0.05F * static_cast<float>(i), 13, 1};
        const float share = unhidden_share(shadows, 0, place);
        EXPECT_EQ(unhidden_share(shadows, 0, Vec3f{place.x, place.y, 7}), 1) << "above what covers";
        (share == 1 ? lit : share == 0 ? dark : between) += 1;
    }
    EXPECT_GT(lit, 70);
    EXPECT_GT(dark, 70);
    EXPECT_GT(between, 0);
    EXPECT_LE(between, 30) << "a texel of 1.3 m, 26 places";
    EXPECT_EQ(unhidden_share(shadows, 0, Vec3f{500, 13, 1}), 1) << "outside of the map";
    EXPECT_EQ(lit_share(shadows, 1, Vec3f{3, 13, 1}), 1) << "a lamp without a map";
}

TEST(LampShadows, SnowDimsLinearlyWithinASlice)
{
    Lamp<float> lamp = sun();
    lamp.direction = {0, 0, -1};
    LampShadows shadows;
    shadows.lamps = 1;
    shadows.snow_px = 8;
    shadows.snow_slices = 2;
    shadows.snow_counts[0] = 1;
    shadows.snow_map[0] = snow_lens(lamp, kBox, shadows.snow_px);
    std::vector<float> depths(64 * 3);
    for (std::size_t i = 0; i < depths.size(); ++i) depths[i] = i < 64 ? 0.0F : i < 128 ? 0.4F : 1.0F;
    shadows.snow = depths.data();
    const auto depth = [&](float z) { return snow_depth(shadows, 0, Vec3f{7, 13, z}); };
    EXPECT_NEAR(depth(9), 0, 1e-6) << "above the snow";
    EXPECT_NEAR(depth(6), 0.2, 1e-5);
    EXPECT_NEAR(depth(4), 0.4, 1e-5);
    EXPECT_NEAR(depth(2), 0.7, 1e-5);
    EXPECT_NEAR(depth(-5), 1, 1e-5) << "below it";
    EXPECT_NEAR(lit_share(shadows, 0, Vec3f{7, 13, 2}), std::exp(-0.7), 1e-5);
}

}  // namespace
}  // namespace spindrift::gl
