// SPDX-License-Identifier: MIT
#include "gl/cluster_lamps.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "core/airlight.h"

namespace spindrift::gl
{
namespace
{

/// A camera that looks along its own axes, and lamps of every kind round it.
struct ClusteredLampsTest : testing::Test
{
    std::mt19937 random{5};
    View view;
    std::vector<Lamp<float>> lamps;

    ClusteredLampsTest()
    {
        view.eye = {3, -2, 4};
        const float cosine = std::cos(0.4F), sine = std::sin(0.4F);
        view.right = {cosine, sine, 0};
        view.forward = {-sine, cosine, 0};
        view.width_px = 640;
        view.height_px = 360;
        view.near_m = 0.3F;
        for (int i = 0; i < 70; ++i) lamps.push_back(lamp(i));
    }

    float between(float low, float high)
    {
        return low + (high - low) * static_cast<float>(random() >> 8) * 0x1p-24F;
    }
    Lamp<float> lamp(int i)
    {
        Lamp<float> lamp;
        lamp.position_m = view.eye + Vec3f{between(-30, 30), between(-10, 60), between(-15, 15)};
        lamp.intensity = {1, 1, 1};
        lamp.range_m = between(1, 14);
        if (i % 3 == 0) return lamp;
        lamp.kind = LampKind::spot;
        const Vec3f way{between(-1, 1), between(-1, 1), between(-1, 1)};
        lamp.direction = way * (1 / std::sqrt(dot(way, way)));
        lamp.cos_outer = between(0, 0.99F);
        lamp.cos_inner = between(lamp.cos_outer, 1);
        return lamp;
    }
    /// A place that the camera sees, its guard band included.
    Vec3f seen_place()
    {
        const float depth = std::exp2(between(std::log2(view.near_m), 6));
        const float up = view.tan_half_fov_y * (1 + 2 * view.guard_px / static_cast<float>(view.height_px));
        const float side = view.tan_half_fov_y * (static_cast<float>(view.width_px) + 2 * view.guard_px) /
                           static_cast<float>(view.height_px);
        return view.eye +
               (view.forward + view.right * between(-side, side) + view.up * between(-up, up)) * depth;
    }
    std::size_t cluster_of_place(const LampClusters& clusters, const Vec3f& place) const
    {
        const Vec3f d = place - view.eye;
        const float z = dot(d, view.forward);
        const float per_m = 0.5F * static_cast<float>(view.height_px) / view.tan_half_fov_y / z;
        return static_cast<std::size_t>(
            cluster_of(clusters.grid, 0.5F * static_cast<float>(view.width_px) + dot(d, view.right) * per_m,
                       0.5F * static_cast<float>(view.height_px) + dot(d, view.up) * per_m, z));
    }
    static bool has(const LampClusters& clusters, const std::uint32_t* bits, std::size_t cluster,
                    std::size_t lamp)
    {
        return (bits[cluster * clusters.words + lamp / 32] >> lamp % 32 & 1U) != 0;
    }
};

TEST_F(ClusteredLampsTest, NoLampIsMissingWhereItShines)
{
    const ClusteredLamps sorted(lamps, view);
    const LampClusters clusters = sorted.view();
    std::size_t shining = 0;
    for (int n = 0; n < 20000; ++n)
    {
        const Vec3f place = seen_place();
        const std::size_t cluster = cluster_of_place(clusters, place);
        for (std::size_t i = 0; i < lamps.size(); ++i)
        {
            if (lamp_light(lamps[i], place).irradiance.x == 0) continue;
            ++shining;
            ASSERT_TRUE(has(clusters, clusters.lit, cluster, i)) << "lamp " << i;
        }
    }
    EXPECT_GT(shining, 2000U);
}

TEST_F(ClusteredLampsTest, NoLampIsMissingOnTheWayThere)
{
    const ClusteredLamps sorted(lamps, view);
    const LampClusters clusters = sorted.view();
    std::size_t glowing = 0;
    for (int n = 0; n < 20000; ++n)
    {
        const Vec3f place = seen_place();
        const Vec3f d = place - view.eye;
        const float away = std::sqrt(dot(d, d));
        const std::size_t cluster = cluster_of_place(clusters, place);
        for (std::size_t i = 0; i < lamps.size(); ++i)
        {
            const LitPart<float> part = lit_part(lamps[i], view.eye, d * (1 / away), 0.0F, away);
            if (!(part.to > part.from)) continue;
            ++glowing;
            ASSERT_TRUE(has(clusters, clusters.on_the_way, cluster, i)) << "lamp " << i;
        }
    }
    EXPECT_GT(glowing, 10000U);
}

TEST_F(ClusteredLampsTest, MostLampsAreLeftOutOfACluster)
{
    const ClusteredLamps sorted(lamps, view);
    const LampClusters clusters = sorted.view();
    std::size_t lit = 0, really_lit = 0;
    const int places = 5000;
    for (int n = 0; n < places; ++n)
    {
        const Vec3f place = seen_place();
        const std::size_t cluster = cluster_of_place(clusters, place);
        for (std::size_t word = 0; word < clusters.words; ++word)
            lit += static_cast<std::size_t>(std::popcount(clusters.lit[cluster * clusters.words + word]));
        for (const Lamp<float>& lamp : lamps) really_lit += lamp_light(lamp, place).irradiance.x > 0;
    }
    EXPECT_LT(static_cast<double>(lit), 0.1 * places * static_cast<double>(lamps.size()));
    EXPECT_GT(lit, really_lit);
}

TEST_F(ClusteredLampsTest, LampsWithoutAnEndAreEverywhere)
{
    lamps.assign(40, lamps[0]);
    lamps[3].range_m = std::numeric_limits<float>::infinity();
    lamps[33].kind = LampKind::directional;
    lamps[33].range_m = 0.1F;
    EXPECT_EQ(count_bounded(lamps), 38U);
    const ClusteredLamps sorted(lamps, view);
    const LampClusters clusters = sorted.view();
    for (std::size_t cluster = 0; cluster < ClusterGrid::count(); ++cluster)
        for (const std::uint32_t* bits : {clusters.lit, clusters.on_the_way})
        {
            EXPECT_TRUE(has(clusters, bits, cluster, 3));
            EXPECT_TRUE(has(clusters, bits, cluster, 33));
        }
}

}  // namespace
}  // namespace spindrift::gl
