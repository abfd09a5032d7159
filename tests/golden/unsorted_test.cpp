// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

#include "gl/context.h"
#include "image/compare.h"
#include "tests/golden/gl_picture.h"
#include "tests/golden/reference_picture.h"
#include "tests/golden/small_scenes.h"

namespace spindrift::golden
{
namespace
{

using scene::Blending;
using scene::FlakePath;

// Blending without a sort, both ways to draw, against the reference renderer, whose flakes are in exact
// order. In the same light weighted blending is exact: gl_against_reference_test has that.

class Unsorted : public testing::TestWithParam<FlakePath>
{
  protected:
    static void SetUpTestSuite() { context_ = gl::make_headless_context(); }
    static void TearDownTestSuite() { context_.reset(); }
    static std::unique_ptr<gl::Context> context_;

    /// Flakes in the light of lamps: some bright before dark ones, some behind.
    static SmallScene lit_scene(Blending blending)
    {
        SmallScene small = flakes_by_a_wall(2000);
        enlarge(small, 120);
        light_up(small);
        small.scene.render.blending = blending;
        small.scene.render.flake_path = GetParam();
        return small;
    }
    static double total(const image::Image& image)
    {
        double sum = 0;
        for (std::size_t i = 0; i < image.rgba.size(); ++i)
            if (i % 4 != 3) sum += double{image.rgba[i]};
        return sum;
    }
};

std::unique_ptr<gl::Context> Unsorted::context_;

TEST_P(Unsorted, NeedsNoOrder)
{
    for (const Blending blending : {Blending::weighted, Blending::stochastic})
    {
        SmallScene small = lit_scene(blending);
        const image::Image one = draw_with_gl(small).linear;
        const image::Image other = draw_with_gl(small, Order::near_to_far).linear;
        const image::Difference off = image::compare(one, other, 1e-2);
        EXPECT_LE(off.relative_l2, 1e-3) << static_cast<int>(blending);
        SmallScene sorted = lit_scene(Blending::over);
        EXPECT_GT(image::compare(draw_with_gl(sorted, Order::near_to_far).linear, one, 1e-2).relative_l2,
                  0.03)
            << "where order matters";
    }
}

TEST_P(Unsorted, StochasticFlakesAreRightOnAverage)
{
    SmallScene small = lit_scene(Blending::stochastic);
    const image::Image truth = reference_picture(small);
    double last = 1e9;
    for (const int samples : {2, 16})
    {
        small.scene.render.samples = samples;
        const GlPicture drawn = draw_with_gl(small);
        EXPECT_EQ(drawn.errors, "");
        // The noise of some thousand bright pixels in the sum.
        EXPECT_NEAR(total(drawn.linear) / total(truth), 1, 8e-3) << samples;
        const double off = image::compare(drawn.linear, truth, 1e-2).relative_l2;
        std::printf("%d samples: relative L2 %.3f, light %.4f\n", samples, off,
                    total(drawn.linear) / total(truth));
        EXPECT_LT(off, 0.35 * last) << "eight times the samples leave a third of the noise at most";
        EXPECT_GT(off, 1e-3) << "it is noise, and not the sort";
        last = off;
    }
}

TEST_P(Unsorted, WeightedFlakesAreNearTheSortedOnes)
{
    SmallScene small = lit_scene(Blending::weighted);
    const GlPicture drawn = draw_with_gl(small);
    EXPECT_EQ(drawn.errors, "");
    const image::Image truth = reference_picture(small);
    small.flakes = {};
    const double of_flakes = image::compare(reference_picture(small), truth, 1e-2).relative_l2;
    const double off = image::compare(drawn.linear, truth, 1e-2).relative_l2;
    EXPECT_LT(off, 0.3 * of_flakes);
    EXPECT_GT(off, 1e-3) << "nor is it the sort";
}

INSTANTIATE_TEST_SUITE_P(BothWays, Unsorted, testing::Values(FlakePath::raster, FlakePath::tiles),
                         [](const testing::TestParamInfo<FlakePath>& tested)
                         { return tested.param == FlakePath::tiles ? "tiles" : "raster"; });

}  // namespace
}  // namespace spindrift::golden
