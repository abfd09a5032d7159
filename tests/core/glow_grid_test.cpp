// SPDX-License-Identifier: MIT
#include "core/glow_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/core/glow_nodes.h"

namespace spindrift
{
namespace
{

/// Six lamps along a street in falling snow, and somebody who looks along it.
struct Street
{
    AirLayers<double> air{3.912023 / 150, 0, 1, 0};  // 150 m of visibility
    double g = 0.67;
    double flakes_hide = 0.3;  // share of the extinction that drawn flakes stand for
    Vec3d eye{80, 8, 6}, forward{0, 1, 0};

    std::vector<Lamp<double>> lamps() const
    {
        std::vector<Lamp<double>> lamps;
        for (int i = 0; i < 6; ++i)
        {
            Lamp<double> lamp;
            lamp.position_m = {68.0 + 24 * (i % 2), 16.0 + 16 * (i / 2), 6};
            lamp.intensity = {15, 15, 15};
            lamp.range_m = 16;
            lamp.phase.g = g;
            lamps.push_back(lamp);
        }
        return lamps;
    }
    AirPath<double> path(const Vec3d& way) const
    {
        return {air, {{30, 10, 0}, {130, 90, 20}, 1, shade()}, eye, way, dot(way, forward)};
    }
    std::vector<float> nodes(const Lamp<double>& lamp) const
    {
        return glow_nodes(lamp, eye, [&](const Vec3d& way) { return path(way); });
    }
    /// The integral in twelve parts of the angle, of 8 points each; the first, where light comes straight on,
    /// is the smallest.
    double truth(const Lamp<double>& lamp, const Vec3d& way, double to_m) const
    {
        const GlowSpan<double> span(lamp, {lamp, eye}, way);
        const double end_m = std::clamp(to_m, span.from_m, span.to_m),
                     turned = span.angle(end_m) - span.begin;
        double sum = 0, from_m = span.from_m;
        constexpr int kParts = 12;
        for (int i = 1; i <= kParts; ++i)
        {
            const double angle = span.begin + turned * std::pow(static_cast<double>(i) / kParts, 2);
            const double at_m = i == kParts ? end_m : span.nearest_m + span.least_m * std::tan(angle);
            sum += glow_of_part(path(way), lamp, from_m, at_m);
            from_m = at_m;
        }
        return sum;
    }

  private:
    FlakeShade<double> shade() const
    {
        area_.clear();
        integral_.clear();
        const double area_m2 = air.uniform_per_m * flakes_hide;
        for (int i = 0; i < 64; ++i)
        {
            area_.push_back(area_m2);
            integral_.push_back(area_m2 * std::exp2(-3 + i / 6.0));
        }
        return {area_.data(), integral_.data(), 64, -3, 6};
    }
    mutable std::vector<double> area_, integral_;
};

struct Errors
{
    double rms = 0, worst = 0;
    void add(double error, int of)
    {
        rms = std::sqrt(rms * rms + error * error / of);
        worst = std::max(worst, std::abs(error));
    }
};

struct Found
{
    Errors grid, each_way;
};

/// Errors over places before the eye, of all light that comes from a flake there.
Found errors(const Street& street)
{
    const std::vector<Lamp<double>> lamps = street.lamps();
    std::vector<std::vector<float>> grids;
    for (const Lamp<double>& lamp : lamps) grids.push_back(street.nodes(lamp));
    std::mt19937 random(3);
    const auto unit = [&random] { return static_cast<double>(random() >> 8) * 0x1p-24; };
    Found found;
    constexpr int kPlaces = 200;
    for (int n = 0; n < kPlaces; ++n)
    {
        const double depth_m = 2 + 78 * unit();
        const Vec3d off{depth_m * (1.6 * unit() - 0.8), depth_m,
                        std::max(depth_m * (0.9 * unit() - 0.45), 0.1 - street.eye.z)};
        const double away_m = std::sqrt(dot(off, off));
        const Vec3d way = off * (1 / away_m), place = street.eye + off;
        const AirPath<double> path = street.path(way);
        double own = 0, truth = 0, by_grid = 0, by_way = 0;
        for (std::size_t i = 0; i < lamps.size(); ++i)
        {
            own += scattered(lamp_light(lamps[i], place), lamps[i].phase, way * -1.0).x *
                   reaching(street.air, lamps[i], place);
            truth += street.truth(lamps[i], way, away_m) * lamps[i].intensity.x;
            by_grid +=
                glow_in_grid(grids[i].data(), lamps[i], street.eye, way, away_m) * lamps[i].intensity.x;
            by_way += airlight_to(path, lamps[i], away_m).x;
        }
        constexpr double kAmbient = 0.014;
        const double light = own * std::exp(-path.of_fog(away_m)) + kAmbient + truth;
        found.grid.add((by_grid - truth) / light, kPlaces);
        found.each_way.add((by_way - truth) / light, kPlaces);
    }
    return found;
}

TEST(GlowGrid, IsNearerToTheTruthThanEightPointsOnEachWay)
{
    struct Case
    {
        const char* name;
        Street street;
    };
    std::vector<Case> cases(5);
    cases[0].name = "street";
    cases[1].name = "sharper lobe, g = 0.77";
    cases[1].street.g = 0.77;
    cases[2].name = "drift 1.5 m high";
    cases[2].street.air = {3.912023 / 150, 0.05, 1.5, 0};
    cases[2].street.eye.z = 2;
    cases[3].name = "flakes stand for 70 %";
    cases[3].street.flakes_hide = 0.7;
    cases[4].name = "among the lamps";
    cases[4].street.eye = {70, 30, 5};
    std::printf("| error of a flake's light, %% | grid: rms | worst | each way: rms | worst |\n");
    for (const Case& c : cases)
    {
        const Found found = errors(c.street);
        std::printf("| %s | %.2f | %.2f | %.2f | %.2f |\n", c.name, 100 * found.grid.rms,
                    100 * found.grid.worst, 100 * found.each_way.rms, 100 * found.each_way.worst);
        EXPECT_LT(found.grid.rms, 0.003) << c.name;
        EXPECT_LT(found.grid.worst, 0.01) << c.name;
        EXPECT_LT(found.grid.rms, found.each_way.rms) << c.name;
    }
}

TEST(GlowGrid, IsExactOnItsOwnWays)
{
    const Street street;
    const Lamp<double> lamp = street.lamps()[3];
    const std::vector<float> nodes = street.nodes(lamp);
    const GlowAxes<double> axes(lamp, street.eye);
    for (const int ring : {0, 1, 7, 15})
        for (const int turn : {0, 5, 12, 18, 23})
        {
            const Vec3d way = glow_way(axes, ring, turn);
            EXPECT_NEAR(
                glow_in_grid(nodes.data(), lamp, street.eye, way, 1000.0) / street.truth(lamp, way, 1000), 1,
                1e-3)
                << ring << " " << turn;
        }
}

TEST(GlowGrid, IsDarkBeforeAndBesideTheLampsRange)
{
    const Street street;
    const Lamp<double> lamp = street.lamps()[4];  // 40 m and more away
    const std::vector<float> nodes = street.nodes(lamp);
    const GlowAxes<double> axes(lamp, street.eye);
    EXPECT_EQ(glow_in_grid(nodes.data(), lamp, street.eye, axes.axis, 15.0), 0);
    EXPECT_GT(glow_in_grid(nodes.data(), lamp, street.eye, axes.axis, 60.0), 0);
    EXPECT_EQ(glow_in_grid(nodes.data(), lamp, street.eye, axes.across, 100.0), 0);
    EXPECT_EQ(glow_in_grid(nodes.data(), lamp, street.eye, axes.axis * -1.0, 100.0), 0);
}

TEST(GlowGrid, FloatFollowsDouble)
{
    for (const double above : {0.0, 9.0})  // beside the eye's height, and straight above the eye
    {
        const Street street;
        Lamp<double> wide = street.lamps()[0];
        if (above > 0) wide.position_m = street.eye + Vec3d{0, 0, above};
        const std::vector<float> nodes = street.nodes(wide);
        Lamp<float> lamp;
        lamp.position_m = {static_cast<float>(wide.position_m.x), static_cast<float>(wide.position_m.y),
                           static_cast<float>(wide.position_m.z)};
        lamp.range_m = 16;
        for (int i = 0; i < 300; ++i)
        {
            const double turn = 2.4 * i, height = std::sin(0.7 * i);
            const double level = std::sqrt(1 - height * height);
            const Vec3d way{level * std::cos(turn), level * std::sin(turn), height};
            const double truth = glow_in_grid(nodes.data(), wide, street.eye, way, 12.0);
            const float narrow = glow_in_grid(
                nodes.data(), lamp,
                Vec3f{static_cast<float>(street.eye.x), static_cast<float>(street.eye.y),
                      static_cast<float>(street.eye.z)},
                Vec3f{static_cast<float>(way.x), static_cast<float>(way.y), static_cast<float>(way.z)},
                12.0F);
            ASSERT_NEAR(narrow, truth, 2e-3 * truth + 1e-9) << i;
        }
        const Vec3f through = lamp.position_m - Vec3f{80, 8, 6};
        const float away = std::sqrt(dot(through, through));
        EXPECT_TRUE(
            std::isfinite(glow_in_grid(nodes.data(), lamp, Vec3f{80, 8, 6}, through * (1 / away), 100.0F)));
        EXPECT_TRUE(std::isfinite(glow_in_grid(nodes.data(), lamp, lamp.position_m, Vec3f{0, 1, 0}, 100.0F)));
    }
}

}  // namespace
}  // namespace spindrift
