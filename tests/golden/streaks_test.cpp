// SPDX-License-Identifier: MIT
#include "core/streak.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

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
using scene::Sprite;

TEST(Streak, ProfileIsTheMeanOverTheWay)
{
    for (const double half : {0.1, 0.7, 3.0, 40.0})
        for (const bool discs : {false, true})
        {
            const Streak<double> streak{0.6, -0.8, half, 0};
            for (const double s : {0.0, 0.3, half - 0.5, half + 0.5})
                for (const double q : {-0.9, 0.0, 0.4})
                {
                    double mean = 0;
                    constexpr int steps = 20000;
                    for (int i = 0; i < steps; ++i)
                    {
                        const double at = s - half * (2 * (i + 0.5) / steps - 1), rho2 = at * at + q * q;
                        if (rho2 <= 1) mean += (discs ? 1 : sprite_profile(rho2)) / steps;
                    }
                    const double px = s * 0.6 + q * 0.8, py = -s * 0.8 + q * 0.6;
                    EXPECT_NEAR(streak_profile(streak, px, py, discs), mean, 2e-4) << half << ' ' << s;
                }
        }
}

TEST(Streak, EvenShareKeepsWhatAWeightedFlakeHides)
{
    constexpr int rings = 4000;
    for (const double opacity : {0.01, 0.4, 0.9, 0.9999})
        for (const double real_flakes : {0.3, 1.0, 4.0, 30.0})
        {
            double hidden = 0, gauss = 0;
            for (int i = 0; i < rings; ++i)
            {
                const double profile = sprite_profile((i + 0.5) / rings);
                hidden += weighted_opacity(opacity * profile, real_flakes) / rings;
                gauss += profile / rings;
            }
            const double even = even_share(opacity, real_flakes);
            const double streak = weighted_opacity(opacity, real_flakes) * ((1 - even) * gauss + even);
            // Below one real flake a drawn one is nearly a disc with a sharp top.
            EXPECT_NEAR(streak / hidden, 1, real_flakes < 1 ? 2e-2 : 2e-3) << opacity << ' ' << real_flakes;
        }
}

class Streaks : public testing::TestWithParam<FlakePath>
{
  protected:
    static void SetUpTestSuite() { context_ = gl::make_headless_context(); }
    static void TearDownTestSuite() { context_.reset(); }
    static std::unique_ptr<gl::Context> context_;

    static void let_fly(SmallScene& small, double shutter_s)
    {
        small.scene.render.flake_path = GetParam();
        small.scene.render.shutter_s = shutter_s;
        small.world.wind.uniform_m_s = {4, -2, 1};
    }
    static double total(const image::Image& image)
    {
        double sum = 0;
        for (std::size_t i = 0; i < image.rgba.size(); i += 4) sum += double{image.rgba[i]};
        return sum;
    }
    /// Apart from each other and from the picture's border. `weight`: real flakes over the drawn area.
    static SmallScene lone_flakes(double enlargement, double weight)
    {
        SmallScene small = empty_scene();
        enlarge(small, enlargement);
        small.world.snow.weight *= static_cast<float>(weight);
        for (int i = 0; i < 70; ++i)
            small.flakes.add({20 + (static_cast<float>(i % 10) - 4.5F) * 0.61F, 7,
                              5 + (static_cast<float>(i / 10) - 3.0F) * 0.59F},
                             static_cast<std::uint32_t>(i) * 2654435761U);
        let_fly(small, 0);
        return small;
    }
};

std::unique_ptr<gl::Context> Streaks::context_;

TEST_P(Streaks, LookLikeTheReference)
{
    for (const Sprite sprite : {Sprite::crystal, Sprite::point})
    {
        SmallScene small = flakes_by_a_wall(600);
        enlarge(small, 40);
        small.world.snow.weight *= 1.7F;
        small.scene.render.sprite = sprite;
        light_up(small);
        let_fly(small, 1 / 30.0);
        const GlPicture drawn = draw_with_gl(small);
        EXPECT_EQ(drawn.errors, "");
        const image::Image truth = reference_picture(small);
        const image::Difference off = image::compare(drawn.linear, truth, 1e-2);
        std::printf("relative L2 %.2e, %.3f %% of pixels off by more than 1e-2\n", off.relative_l2,
                    100 * off.share_above);
        EXPECT_LE(off.relative_l2, 5e-3);
        EXPECT_LE(off.share_above, 5e-3);
        small.scene.render.shutter_s = 0;
        EXPECT_GT(image::compare(reference_picture(small), truth, 1e-2).relative_l2, 0.1) << "they move";
    }
}

TEST_P(Streaks, KeepTheLightAndWhatTheyHide)
{
    for (const double enlargement : {60.0, 200.0})  // about 1 and 4 px in radius
        for (const double weight : {0.5, 1.0, 3.0})
        {
            SmallScene small = lone_flakes(enlargement, weight);
            const scene::Colour black{0, 0, 0}, white{1, 1, 1};
            for (const bool bright : {true, false})
            {
                small.scene.sky = bright ? scene::SkySettings{black, black, white}
                                         : scene::SkySettings{white, white, black};
                const double pixels = 160 * 120;
                const auto of_flakes = [&](const image::Image& picture)
                { return bright ? total(picture) : pixels - total(picture); };
                small.scene.render.shutter_s = 0;
                const double still = of_flakes(draw_with_gl(small).linear);
                EXPECT_GT(still, 5);
                for (const double shutter_s : {0.004, 1 / 60.0, 0.05})
                {
                    small.scene.render.shutter_s = shutter_s;
                    const double moving = of_flakes(draw_with_gl(small).linear);
                    // A crystal's weight is taken of its mask at rest, of the mask's mean in a streak.
                    const double bound = enlargement > 100 && weight != 1 ? 0.08 : 0.02;
                    EXPECT_NEAR(moving / still, 1, bound) << enlargement << ' ' << weight << ' ' << shutter_s;
                }
            }
        }
}

INSTANTIATE_TEST_SUITE_P(BothWays, Streaks, testing::Values(FlakePath::raster, FlakePath::tiles),
                         [](const testing::TestParamInfo<FlakePath>& tested)
                         { return tested.param == FlakePath::tiles ? "tiles" : "raster"; });

}  // namespace
}  // namespace spindrift::golden
