// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <memory>
#include <vector>

#include "core/phase.h"
#include "cpu/tile_splatter.h"
#include "gl/context.h"
#include "gl/frame_plan.h"
#include "image/compare.h"
#include "tests/golden/gl_picture.h"
#include "tests/golden/reference_picture.h"
#include "tests/golden/small_scenes.h"

namespace spindrift::golden
{
namespace
{

using scene::FlakePath;

/// Lamps that end after some metres, among the flakes: points and spots by turns.
void add_lamps(SmallScene& small, int count)
{
    for (int i = 0; i < count; ++i)
    {
        scene::Light lamp;
        lamp.position_m = {20.0 + 7 * std::sin(i * 2.4), 4.0 + 0.5 * i, 5.0 + 4 * std::cos(i * 1.7)};
        lamp.intensity = {4, 3, static_cast<float>(i % 5)};
        lamp.range_m = 2 + i % 7;
        if (i % 2 == 1)
        {
            lamp.kind = scene::LightKind::spot;
            lamp.direction = {0.6, 0, -0.8};
            lamp.inner_cone_deg = 15;
            lamp.outer_cone_deg = 20 + i % 60;
        }
        small.scene.lights.push_back(lamp);
    }
}

SmallScene lit_scene(int lamps, bool thick)
{
    SmallScene small = flakes_by_a_wall(1000);
    enlarge(small, 40);
    light_up(small);
    if (thick) thicken(small);
    add_lamps(small, lamps);
    return small;
}

/// Every frame twice: as it is asked, and with every lamp for every flake.
class WithoutClustersToo final : public Splatter
{
  public:
    void splat(const SplatJob& job, const SplatPicture& picture) override
    {
        clustered_ = clustered_ || job.clusters.words > 0;
        const auto pixels =
            static_cast<std::size_t>(picture.width_px) * static_cast<std::size_t>(picture.height_px);
        std::vector<std::uint16_t> all(picture.rgba, picture.rgba + 4 * pixels);
        SplatJob job_for_all = job;
        job_for_all.clusters = {};
        SplatPicture with_all = picture;
        with_all.rgba = all.data();
        with_all.tone = nullptr;
        splatter_->splat(job_for_all, with_all);
        splatter_->splat(job, picture);
        same_ = same_ && std::equal(all.begin(), all.end(), picture.rgba);
    }
    bool clustered() const { return clustered_; }
    bool same() const { return same_; }

  private:
    std::unique_ptr<Splatter> splatter_ = cpu::make_tile_splatter({});
    bool clustered_ = false, same_ = true;
};

class ManyLamps : public testing::Test
{
  protected:
    static void SetUpTestSuite() { context_ = gl::make_headless_context(); }
    static void TearDownTestSuite() { context_.reset(); }
    static std::unique_ptr<gl::Context> context_;
};

std::unique_ptr<gl::Context> ManyLamps::context_;

TEST_F(ManyLamps, CountOnlyWhereTheyReachWithoutChangingABit)
{
    for (const bool thick : {false, true})
        for (const int lamps : {2, 45})
        {
            SmallScene small = lit_scene(lamps, thick);
            small.scene.render.flake_path = FlakePath::tiles;
            WithoutClustersToo splatter;
            draw_with_gl(small, splatter);
            EXPECT_TRUE(splatter.clustered());
            EXPECT_TRUE(splatter.same()) << lamps << " lamps" << (thick ? " in thick air" : "");
        }
}

TEST_F(ManyLamps, LookLikeTheReferenceThatComputesThemAll)
{
    for (const bool thick : {false, true})
    {
        SmallScene small = lit_scene(25, thick);
        // The glow of a sharp lobe is nearer to the truth from grids than the reference's eight points
        // (tests/core/glow_grid_test.cpp): lobes that both know well.
        for (scene::Light& light : small.scene.lights)
        {
            light.phase = PhaseKind::henyey_greenstein;
            light.g = 0.4;
        }
        const image::Image truth = reference_picture(small);
        SmallScene few = lit_scene(0, thick);
        EXPECT_GT(image::compare(reference_picture(few), truth, 1e-2).relative_l2, 0.02)
            << "the lamps matter";
        for (const FlakePath path : {FlakePath::raster, FlakePath::tiles})
        {
            small.scene.render.flake_path = path;
            const image::Difference off = image::compare(draw_with_gl(small).linear, truth, 1e-2);
            std::printf("many lamps: relative L2 %.4f, %.3f %% of pixels off by more than 1e-2\n",
                        off.relative_l2, 100 * off.share_above);
            EXPECT_LE(off.relative_l2, thick ? 2.5e-3 : 1.5e-3);
            EXPECT_LE(off.share_above, thick ? 2e-2 : 1e-2);
        }
    }
}

TEST_F(ManyLamps, GlowFromGridsAsOnEachWay)
{
    // What the reference integrates anew on each way, in eight points: they are off by a per cent or so.
    SmallScene small = flakes_by_a_wall(1000);
    enlarge(small, 40);
    light_up(small);
    thicken(small);
    small.scene.lights.clear();
    for (int i = 0; i < 10; ++i)
    {
        scene::Light lamp;
        lamp.position_m = {14.0 + 12 * (i % 2), 8.0 + 5 * (i / 2), 4.0 + i % 3};
        lamp.intensity = {4, 3, 1};
        lamp.range_m = 14;
        small.scene.lights.push_back(lamp);
    }
    const image::Image truth = reference_picture(small);
    SmallScene dull = small;
    dull.scene.air.airlight = false;
    EXPECT_GT(image::compare(reference_picture(dull), truth, 1e-2).relative_l2, 0.2) << "they glow";
    gl::FrameStats stats;
    stats.counts.alive = 1000;
    EXPECT_TRUE(gl::plan_frame(small.scene, small.view, stats, small.time_s).lit.glow_grids);
    for (const FlakePath path : {FlakePath::raster, FlakePath::tiles})
    {
        small.scene.render.flake_path = path;
        const GlPicture drawn = draw_with_gl(small);
        EXPECT_EQ(drawn.errors, "");
        const double off = image::compare(drawn.linear, truth, 1e-2).relative_l2;
        std::printf("glow from grids: relative L2 %.4f\n", off);
        EXPECT_LE(off, 0.015);
    }
}

TEST_F(ManyLamps, WithoutARangeEndWithinTheStatedError)
{
    SmallScene small = flakes_by_a_wall(1000);
    enlarge(small, 40);
    add_lamps(small, 30);
    double most = 0;
    const double dimmest = 0.02;
    for (scene::Light& lamp : small.scene.lights)
    {
        lamp.range_m = std::numeric_limits<double>::infinity();
        lamp.g = 0.5;
        most += std::max(henyey_greenstein(0.5, 1.0), 1 / 3.14159) * dimmest;
    }
    const image::Image truth = reference_picture(small);
    for (const FlakePath path : {FlakePath::raster, FlakePath::tiles})
    {
        small.scene.render.flake_path = path;
        small.scene.render.dimmest_lamp_w_m2 = 0;
        const image::Image exact = draw_with_gl(small).linear;
        small.scene.render.dimmest_lamp_w_m2 = dimmest;
        const image::Difference off = image::compare(draw_with_gl(small).linear, exact, 1e-3);
        EXPECT_GT(off.share_above, 0.1) << "it does something";
        EXPECT_LE(off.worst, most);
        EXPECT_LE(image::compare(exact, truth, 1e-2).relative_l2, 1e-3);
    }
}

}  // namespace
}  // namespace spindrift::golden
