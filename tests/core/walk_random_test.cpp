// SPDX-License-Identifier: MIT
// The walk against a tracer that shares no idea with it: small steps, each with at most one face.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "core/walk.h"
#include "voxel_town.h"

namespace
{

using spindrift::Contact;
using spindrift::Fate;
using spindrift::Solids;
using spindrift::Vec3d;
using spindrift_test::VoxelTown;

/// Follows a path in double with steps of a hundredth of a cell and mirrors it at faces.
class Tracer
{
  public:
    Tracer(const VoxelTown& town, const Solids& solids) : town_(town), solids_(solids) {}

    struct Outcome
    {
        double end[3];
        Fate fate = Fate::alive;
        int bounces[3] = {0, 0, 0};
        double margin =
            1;  ///< smallest distance in cells at which the path passed an edge, or ended from a face
        bool certain = true;  ///< no two faces within one hair's breadth
    };

    Outcome trace(const Vec3d& start, const Vec3d& displacement)
    {
        const double scale = 1 / static_cast<double>(solids_.voxels.cell_m);
        const spindrift::Vec3f o = solids_.voxels.origin_m;
        at_[0] = (start.x - o.x) * scale, at_[1] = (start.y - o.y) * scale, at_[2] = (start.z - o.z) * scale;
        way_[0] = displacement.x * scale, way_[1] = displacement.y * scale, way_[2] = displacement.z * scale;
        ground_ = (solids_.ground_m - o.z) * scale;
        out_ = {};
        const double length = std::sqrt(way_[0] * way_[0] + way_[1] * way_[1] + way_[2] * way_[2]);
        const int steps = static_cast<int>(length * 100) + 1;
        for (int i = 0; i < steps && out_.fate == Fate::alive && out_.certain; ++i) advance(1.0 / steps, 0);
        for (int k = 0; k < 3; ++k)
        {
            if (out_.fate == Fate::alive) note_margin(at_[k]);
            out_.end[k] = at_[k] / scale + (k == 0 ? o.x : k == 1 ? o.y : o.z);
        }
        return out_;
    }

  private:
    void note_margin(double x) { out_.margin = std::min(out_.margin, std::abs(x - std::nearbyint(x))); }

    void advance(double dt, int depth)
    {
        double next[3];
        int crossed = 0, axis = -1;
        for (int k = 0; k < 3; ++k)
        {
            next[k] = at_[k] + way_[k] * dt;
            if (std::floor(next[k]) != std::floor(at_[k])) ++crossed, axis = k;
        }
        const bool grounded = solids_.has_ground && next[2] < ground_;
        if (crossed + (grounded ? 1 : 0) > 1)
        {
            if (depth > 30)
                out_.certain = false;
            else
            {
                advance(dt / 2, depth + 1);
                if (out_.fate == Fate::alive && out_.certain) advance(dt / 2, depth + 1);
            }
            return;
        }
        if (grounded) return meet(next, 2, ground_, solids_.ground);
        if (crossed == 1)
        {
            const double face = way_[axis] > 0 ? std::floor(next[axis]) : std::floor(at_[axis]);
            for (int k = 0; k < 3; ++k)
                if (k != axis) note_margin(next[k]);
            const int x = static_cast<int>(std::floor(next[0])), y = static_cast<int>(std::floor(next[1])),
                      z = static_cast<int>(std::floor(next[2]));
            if (town_.is_solid(x, y, z))
            {
                const auto index = (z * solids_.voxels.ny + y) * solids_.voxels.nx + x;
                return meet(next, axis, face, solids_.surfaces[solids_.voxels.surface[index]]);
            }
        }
        for (int k = 0; k < 3; ++k) at_[k] = next[k];
    }

    void meet(const double* next, int axis, double face, const spindrift::Surface& surface)
    {
        const double share = (face - at_[axis]) / (next[axis] - at_[axis]);
        for (int k = 0; k < 3; ++k)
            if (surface.contact == Contact::bounce)
                at_[k] = k == axis ? face - (next[k] - face) : next[k];
            else
                at_[k] += (next[k] - at_[k]) * share;
        if (surface.contact != Contact::bounce)
        {
            at_[axis] = face;
            out_.fate = surface.contact == Contact::land ? Fate::landed : Fate::vanished;
            return;
        }
        // a mirrored end on the very face, or a gap narrower than a step, is not for this tracer
        if (std::floor(at_[axis]) == std::floor(next[axis]) && axis != 2) out_.certain = false;
        if (solids_.has_ground && at_[2] < ground_) out_.certain = false;
        if (town_.is_solid(static_cast<int>(std::floor(at_[0])), static_cast<int>(std::floor(at_[1])),
                           static_cast<int>(std::floor(at_[2]))))
            out_.certain = false;
        way_[axis] = -way_[axis];
        ++out_.bounces[axis];
    }

    const VoxelTown& town_;
    const Solids& solids_;
    double at_[3]{}, way_[3]{}, ground_ = 0;
    Outcome out_;
};

VoxelTown random_town(std::mt19937& random, double share)
{
    VoxelTown town(14, 11, 9, 0.5F, {3, -2, 1});
    town.world().surfaces = {
        {Contact::bounce, 0.5F}, {Contact::land, 0}, {Contact::vanish, 0}, {Contact::bounce, 1}};
    std::uniform_real_distribution<double> uniform(0, 1);
    for (int z = 0; z < 9; ++z)
        for (int y = 0; y < 11; ++y)
            for (int x = 0; x < 14; ++x)
                if (uniform(random) < share)
                {
                    const double kind = uniform(random);
                    town.solid(x, y, z, kind < 0.02 ? 1 : kind < 0.04 ? 2 : kind < 0.5 ? 3 : 0);
                }
    town.world().has_ground = true;
    town.world().ground_m = 1.2F;  // within the lowest cells
    town.world().ground = {uniform(random) < 0.7 ? Contact::bounce : Contact::land, 0.5F};
    return town;
}

struct Counts
{
    int compared = 0, bounced = 0, stopped = 0, unsure = 0;
};

template <class R>
Counts compare(double share, double reach_m, double tolerance_m, double margin)
{
    std::mt19937 random(7);
    std::uniform_real_distribution<double> uniform(0, 1);
    Counts counts;
    for (int t = 0; t < 8; ++t)
    {
        VoxelTown town = random_town(random, share);
        const Solids solids = town.finish();
        Tracer tracer(town, solids);
        spindrift::VoxelWalker<R> walker(solids);
        for (int i = 0; i < 250; ++i)
        {
            // also from outside the grid; float values, so that both start from the same point
            const Vec3d start{static_cast<float>(2 + 9 * uniform(random)),
                              static_cast<float>(-3 + 7 * uniform(random)),
                              static_cast<float>(1.25 + 5 * uniform(random))};
            const double size = reach_m * uniform(random);
            const Vec3d way{static_cast<float>(size * (2 * uniform(random) - 1)),
                            static_cast<float>(size * (2 * uniform(random) - 1)),
                            static_cast<float>(size * (2 * uniform(random) - 1))};
            const spindrift::Vec3<R> from{static_cast<R>(start.x), static_cast<R>(start.y),
                                          static_cast<R>(start.z)};
            const spindrift::Vec3<R> step{static_cast<R>(way.x), static_cast<R>(way.y),
                                          static_cast<R>(way.z)};
            if (solids.voxels.is_solid(from)) continue;
            const auto result = walker(from, step);
            EXPECT_EQ(result.fault, spindrift::WalkFault::none);
            EXPECT_FALSE(solids.voxels.is_solid(result.end));
            EXPECT_GE(result.end.z, R(solids.ground_m));
            if (spindrift::moves_freely(solids, from, step))
            {
                EXPECT_EQ(result.bounces, 0);
                EXPECT_EQ(result.fate, Fate::alive);
                EXPECT_EQ(result.end.x, from.x + step.x);
            }
            const auto expected = tracer.trace(start, way);
            if (!expected.certain || expected.margin < margin)
            {
                ++counts.unsure;
                continue;
            }
            ++counts.compared;
            counts.bounced += result.bounces > 0 ? 1 : 0;
            counts.stopped += result.fate != Fate::alive ? 1 : 0;
            EXPECT_EQ(result.fate, expected.fate);
            EXPECT_NEAR(result.end.x, expected.end[0], tolerance_m);
            EXPECT_NEAR(result.end.y, expected.end[1], tolerance_m);
            EXPECT_NEAR(result.end.z, expected.end[2], tolerance_m);
            EXPECT_EQ(result.bounces, expected.bounces[0] + expected.bounces[1] + expected.bounces[2]);
            for (int k = 0; k < 3; ++k) EXPECT_EQ((result.mirrored >> k) & 1U, expected.bounces[k] & 1U);
            if (testing::Test::HasFailure()) return counts;
        }
    }
    return counts;
}

// a stop lies up to a 4096th of a cell off the face
constexpr double kInset_m = 0.5 / 4096 + 1e-6;

TEST(WalkAmongRandomSolids, DoubleEndsWhereTheTracerEnds)
{
    for (double share : {0.03, 0.2, 0.5})
    {
        const Counts counts = compare<double>(share, 30, kInset_m, 1e-9);
        EXPECT_GT(counts.compared, 700) << share;
        EXPECT_GT(counts.bounced, counts.compared / 5) << share;
        EXPECT_GT(counts.stopped, 5) << share;
        EXPECT_LT(counts.unsure, counts.compared / 4) << share;
    }
}

TEST(WalkAmongRandomSolids, FloatEndsWhereTheTracerEnds)
{
    for (double share : {0.03, 0.2, 0.5})
    {
        const Counts counts = compare<float>(share, 10, 3e-4, 1e-3);
        EXPECT_GT(counts.compared, 500) << share;
        EXPECT_GT(counts.bounced, counts.compared / 10) << share;
    }
}

TEST(WalkAmongRandomSolids, ManyFloatWalksInARowNeverEndInside)
{
    std::mt19937 random(11);
    std::uniform_real_distribution<float> uniform(-1, 1);
    VoxelTown town = random_town(random, 0.3);
    for (spindrift::Surface& surface : town.world().surfaces) surface.contact = Contact::bounce;
    town.world().ground.contact = Contact::bounce;
    const Solids solids = town.finish();
    spindrift::VoxelWalker<float> walker(solids);
    spindrift::Vec3f at{7, 3.7F, 7};
    for (int i = 0; i < 30000; ++i)
    {
        spindrift::Vec3f way{2 * uniform(random), 2 * uniform(random), 2 * uniform(random)};
        // back towards the middle: the walk stays near the solids
        way = way + (spindrift::Vec3f{6.5F, 0.75F, 3.25F} - at) * 0.1F;
        const auto result = walker(at, way);
        ASSERT_EQ(result.fault, spindrift::WalkFault::none);
        ASSERT_EQ(result.fate, Fate::alive);
        at = result.end;
        ASSERT_FALSE(solids.voxels.is_solid(at)) << i;
    }
}

}  // namespace
