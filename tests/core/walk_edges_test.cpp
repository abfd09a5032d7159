// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/walk.h"
#include "voxel_town.h"

namespace
{

using spindrift::Contact;
using spindrift::Fate;
using spindrift::Solids;
using spindrift::Vec3;
using spindrift::VoxelWalker;
using spindrift::WalkFault;
using spindrift_test::VoxelTown;

/// One copy of the walk for all tests: it is inlined wherever it is called, and that takes the compiler long.
template <class R>
[[gnu::noinline]] spindrift::WalkResult<R> walked(const Solids& solids, const Vec3<R>& start,
                                                  const Vec3<R>& way)
{
    return VoxelWalker<R>(solids)(start, way);
}

template <class R>
class Walk : public testing::Test
{
  protected:
    static bool outside(const Solids& solids, const Vec3<R>& p)
    {
        return !solids.voxels.is_solid(p) && !(solids.has_ground && p.z < R(solids.ground_m));
    }
};
using Numbers = testing::Types<float, double>;
TYPED_TEST_SUITE(Walk, Numbers);

VoxelTown one_block()  // solid cell [1,2)^3 of a 3x3x3 grid at the origin, cell 1 m
{
    VoxelTown town(3, 3, 3, 1, {0, 0, 0});
    town.solid(1, 1, 1);
    return town;
}

TYPED_TEST(Walk, BouncesAndKeepsThePathLength)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    VoxelTown town = one_block();
    const Solids solids = town.finish();
    const auto result = walked<TypeParam>(solids, v(0.5, 1.5, 1.5), v(0.75, 0.25, 0));
    EXPECT_EQ(result.fate, Fate::alive);
    EXPECT_EQ(result.bounces, 1);
    EXPECT_EQ(result.mirrored, 1U);
    EXPECT_NEAR(result.end.x, 0.75, 1e-6);
    EXPECT_NEAR(result.end.y, 1.75, 1e-6);
    EXPECT_EQ(result.kept.x, TypeParam(-0.5));
    EXPECT_EQ(result.kept.y, TypeParam(1));
}

TYPED_TEST(Walk, LandsAndVanishesJustOutside)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    for (Contact contact : {Contact::land, Contact::vanish})
        for (int axis = 0; axis < 3; ++axis)
            for (TypeParam way : {TypeParam(-5), TypeParam(5)})
            {
                VoxelTown town = one_block();
                town.world().surfaces[0].contact = contact;
                const Solids solids = town.finish();
                TypeParam start[3] = {1.5, 1.5, 1.5}, step[3] = {0, 0, 0};
                start[axis] = way > 0 ? TypeParam(-0.5) : TypeParam(3.5);
                step[axis] = way;
                const auto result =
                    walked<TypeParam>(solids, v(start[0], start[1], start[2]), v(step[0], step[1], step[2]));
                EXPECT_EQ(result.fate, contact == Contact::land ? Fate::landed : Fate::vanished);
                EXPECT_TRUE(this->outside(solids, result.end));
                const TypeParam end[3] = {result.end.x, result.end.y, result.end.z};
                EXPECT_NEAR(end[axis], way > 0 ? 1 : 2, 3e-4);
                EXPECT_EQ(result.surface, 0);
            }
}

TYPED_TEST(Walk, AThinWallStopsADisplacementOfHundredsOfCells)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    VoxelTown town(40, 9, 9, 0.5F, {10, -3, 7});
    for (int y = 0; y < 9; ++y)
        for (int z = 0; z < 9; ++z) town.solid(20, y, z);
    town.world().surfaces[0].contact = Contact::land;
    const Solids solids = town.finish();
    const auto result = walked<TypeParam>(solids, v(-90, -1, 9), v(400, 0.3, 0.2));
    EXPECT_EQ(result.fate, Fate::landed);
    EXPECT_NEAR(result.end.x, 20, 3e-4);
    EXPECT_NEAR(result.end.y, -1 + 0.3 * 110.0 / 400, 1e-5);
}

TYPED_TEST(Walk, ASlotOfOneCellFoldsAPathOfHundredsOfCells)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    VoxelTown town(3, 400, 1, 1, {0, 0, 0});
    for (int y = 0; y < 400; ++y) town.solid(0, y, 0), town.solid(2, y, 0);
    const Solids solids = town.finish();
    for (TypeParam reach : {TypeParam(0.3), TypeParam(7.7), TypeParam(123.4), TypeParam(399.1)})
        for (TypeParam way : {TypeParam(1), TypeParam(-1)})
        {
            const auto result = walked<TypeParam>(solids, v(1.25, 0.5, 0.5), v(way * reach, 300, 0));
            const double unfolded = std::fmod(std::abs(0.25 + double{way} * double{reach} + 1000), 2);
            EXPECT_NEAR(result.end.x, 1 + (unfolded > 1 ? 2 - unfolded : unfolded), 2e-4) << reach;
            EXPECT_NEAR(result.end.y, 300.5, 1e-4);
            EXPECT_EQ(result.bounces,
                      static_cast<int>(std::abs(std::floor(0.25 + double{way} * double{reach}))));
            EXPECT_TRUE(this->outside(solids, result.end));
        }
}

TYPED_TEST(Walk, AStartOnAFaceIsOutside)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    VoxelTown town = one_block();
    const Solids solids = town.finish();
    // on the lower x face, which rounding down puts into the solid cell
    for (const auto& step : {v(0.5, 0, 0), v(-0.5, 0, 0), v(0, 0.4, 0), v(0, 0, 0), v(0.5, 0.1, -0.2)})
    {
        const auto result = walked<TypeParam>(solids, v(1, 1.5, 1.5), step);
        EXPECT_EQ(result.fate, Fate::alive);
        EXPECT_EQ(result.fault, WalkFault::none);
        EXPECT_TRUE(this->outside(solids, result.end)) << step.x;
        EXPECT_NEAR(result.end.x, 1 - std::abs(step.x), 3e-4);
    }
    // on the upper face, in the free cell already
    const auto inwards = walked<TypeParam>(solids, v(2, 1.5, 1.5), v(-0.5, 0, 0));
    EXPECT_NEAR(inwards.end.x, 2.5, 1e-6);
    EXPECT_EQ(inwards.bounces, 1);
    // on an edge and on a corner
    for (const auto& corner : {v(1, 1, 1.5), v(1, 1, 1), v(2, 2, 2), v(1, 2, 1)})
        for (TypeParam s : {TypeParam(-0.3), TypeParam(0.3)})
        {
            const auto result = walked<TypeParam>(solids, corner, v(s, s, -s));
            EXPECT_EQ(result.fault, WalkFault::none);
            EXPECT_TRUE(this->outside(solids, result.end));
        }
}

TYPED_TEST(Walk, ExactlyIntoACornerStaysOutside)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    VoxelTown town = one_block();
    const Solids solids = town.finish();
    for (int signs = 0; signs < 8; ++signs)
    {
        const auto way = [signs](int k) { return TypeParam(((signs >> k) & 1) != 0 ? 1 : -1); };
        const auto start = v(TypeParam(1.5) - way(0), TypeParam(1.5) - way(1), TypeParam(1.5) - way(2));
        const auto step = v(way(0) * TypeParam(0.75), way(1) * TypeParam(0.75), way(2) * TypeParam(0.75));
        const auto result = walked<TypeParam>(solids, start, step);
        EXPECT_TRUE(this->outside(solids, result.end)) << signs;
        EXPECT_EQ(result.fault, WalkFault::none);
    }
}

TYPED_TEST(Walk, GrazingAlongAWallNeitherEntersNorSticks)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    VoxelTown town(3, 50, 3, 1, {0, 0, 0});
    for (int y = 0; y < 50; ++y)
        for (int z = 0; z < 3; ++z) town.solid(1, y, z);
    const Solids solids = town.finish();
    const TypeParam just_outside = std::nextafter(TypeParam(1), TypeParam(0));
    for (TypeParam x : {TypeParam(1), just_outside, TypeParam(2)})
        for (TypeParam drift : {TypeParam(0), TypeParam(1e-7), TypeParam(-1e-7)})
        {
            const auto result = walked<TypeParam>(solids, v(x, 0.5, 1.5), v(drift, 45, 0));
            EXPECT_TRUE(this->outside(solids, result.end));
            EXPECT_NEAR(result.end.y, 45.5, 1e-4);
            EXPECT_NEAR(result.end.x, x, 3e-4);
        }
}

TYPED_TEST(Walk, WhatIsNotFiniteDoesNotMoveAndSaysSo)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    VoxelTown town = one_block();
    const Solids solids = town.finish();
    const TypeParam inf = std::numeric_limits<TypeParam>::infinity();
    const TypeParam nan = std::numeric_limits<TypeParam>::quiet_NaN();
    for (TypeParam bad : {inf, -inf, nan, TypeParam(1e30)})
        for (const auto& step : {v(bad, 0, 0), v(0, bad, 0), v(1, 1, bad)})
        {
            const auto start = v(0.5, 0.5, 0.5);
            const auto result = walked<TypeParam>(solids, start, step);
            EXPECT_EQ(result.fault, WalkFault::not_finite);
            EXPECT_EQ(result.fate, Fate::alive);
            EXPECT_EQ(result.end.x, start.x);
            EXPECT_FALSE(spindrift::moves_freely(solids, start, step));
        }
    EXPECT_EQ(walked<TypeParam>(solids, v(nan, 0, 0), v(1, 0, 0)).fault, WalkFault::not_finite);
}

TYPED_TEST(Walk, AStartInsideASolidOrBelowTheGroundVanishes)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    VoxelTown town = one_block();
    town.world().has_ground = true;
    town.world().ground_m = 0.25F;
    const Solids solids = town.finish();
    for (const auto& start : {v(1.5, 1.5, 1.5), v(0.5, 0.5, 0.2)})
    {
        const auto result = walked<TypeParam>(solids, start, v(1, 1, 1));
        EXPECT_EQ(result.fault, WalkFault::began_inside);
        EXPECT_EQ(result.fate, Fate::vanished);
        EXPECT_EQ(result.end.x, start.x);
    }
}

TYPED_TEST(Walk, TheGroundStopsOrReflects)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    spindrift::World world;  // no voxels
    world.has_ground = true;
    world.ground_m = 2.5F;
    world.ground = {Contact::land, 0};
    Solids solids = spindrift::solids_view(world);
    const auto landed = walked<TypeParam>(solids, v(1, 1, 4.5), v(400, 0, -4));
    EXPECT_EQ(landed.fate, Fate::landed);
    EXPECT_EQ(landed.surface, spindrift::kGroundSurface);
    EXPECT_EQ(landed.end.z, TypeParam(2.5));
    EXPECT_NEAR(landed.end.x, 201, 1e-3);
    solids.ground = {Contact::bounce, 0.25F};
    const auto bounced = walked<TypeParam>(solids, v(1, 1, 4.5), v(1, 0, -3));
    EXPECT_NEAR(bounced.end.z, 3.5, 1e-6);
    EXPECT_EQ(bounced.mirrored, 4U);
    EXPECT_EQ(bounced.kept.z, TypeParam(-0.25));
    const auto from_ground = walked<TypeParam>(solids, v(1, 1, 2.5), v(1, 0, -3));
    EXPECT_NEAR(from_ground.end.z, 5.5, 1e-6);
    EXPECT_EQ(walked<TypeParam>(solids, v(1, 1, 2.5), v(1, 0, 3)).bounces, 0);
}

TYPED_TEST(Walk, AGapThinnerThanRoundingEndsInBoundedTime)
{
    const auto v = [](double x, double y, double z) {
        return Vec3<TypeParam>{TypeParam(x), TypeParam(y), TypeParam(z)};
    };
    VoxelTown town(3, 3, 3, 1, {0, 0, 0});
    for (int x = 0; x < 3; ++x)
        for (int y = 0; y < 3; ++y) town.solid(x, y, 1);
    town.world().has_ground = true;
    town.world().ground_m = 0.99999F;
    town.world().ground = {Contact::bounce, 1};
    const Solids solids = town.finish();
    const auto result = walked<TypeParam>(solids, v(1.5, 1.5, TypeParam(0.999995)), v(0.1, 0, 1));
    EXPECT_EQ(result.fault, WalkFault::gave_up);
    EXPECT_LE(result.bounces, spindrift::kMostWalkEvents);
    EXPECT_TRUE(this->outside(solids, result.end));
}

}  // namespace
