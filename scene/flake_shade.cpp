// SPDX-License-Identifier: MIT
#include "scene/flake_shade.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/snow.h"
#include "core/sprite.h"
#include "scene/crystals.h"

namespace spindrift::scene
{

namespace
{

constexpr int kEntries = FlakeShadeTable::kEntries;
constexpr int kStepsPerEntry = 4;
constexpr int kSizes = 150;  ///< samples of the spectrum
constexpr double kLargestExponent =
    24;  ///< exp(-24) of the flakes are larger, and the largest is clamped anyway
constexpr int kOpacities = 33;

/// How much of the unit disc a sprite covers: the integral of its alpha.
class SpriteCover
{
  public:
    SpriteCover(const RenderSettings& render, const Snow& snow)
        : solid_(render.blending == Blending::opaque),
          hides_(render.blending != Blending::additive),
          crystal_(render.sprite == Sprite::crystal),
          opacity_(crystal_ ? render.flake_opacity : 1),
          stands_for_(static_cast<double>(snow.weight) / (render.flake_scale * render.flake_scale))
    {
        for (int i = 0; i < kOpacities; ++i)
            plain_[static_cast<std::size_t>(i)] = plain_cover(static_cast<double>(i) / (kOpacities - 1));
        detail_ = crystal_ ? detailed_cover() / plain_.back() : 1;
    }

    /// `shown`: what nearness and smallness leave of the opacity, 0 to 1; `r`: radius in px.
    double at(double shown, double r) const
    {
        if (!hides_) return 0;
        if (solid_) return std::numbers::pi;
        const double place = std::clamp(shown, 0.0, 1.0) * (kOpacities - 1);
        const auto low = std::min(static_cast<std::size_t>(place), static_cast<std::size_t>(kOpacities - 2));
        const double cover = std::lerp(plain_[low], plain_[low + 1], place - static_cast<double>(low));
        return cover * std::lerp(1.0, detail_, sprite_detail(r));
    }
    bool thins_out() const { return !solid_; }

  private:
    /// With the mean of each mask in place of the mask.
    double plain_cover(double shown) const
    {
        constexpr int rings = 64;  // of equal area
        double sum = 0;
        for (const CrystalMask& mask : crystal_masks())
            for (int i = 0; i < rings; ++i)
            {
                const double whole = crystal_ ? sprite_profile((i + 0.5) / rings) * mask.mean : 1;
                sum += weighted_opacity(shown * opacity_ * whole, stands_for_);
            }
        return std::numbers::pi * sum / (rings * kCrystalShapes);
    }

    /// With the masks themselves.
    double detailed_cover() const
    {
        constexpr int px = kCrystalMaskPx / 2;
        double sum = 0;
        for (const CrystalMask& mask : crystal_masks())
            for (int row = 0; row < px; ++row)
                for (int column = 0; column < px; ++column)
                {
                    const double u = (column + 0.5) * 2 / px - 1, v = (row + 0.5) * 2 / px - 1;
                    if (u * u + v * v > 1) continue;
                    const double ice = mask.levels[1][static_cast<std::size_t>(row * px + column)] / 255.0;
                    sum += weighted_opacity(opacity_ * sprite_profile(u * u + v * v) * ice, stands_for_);
                }
        return sum * 4 / (px * px * kCrystalShapes);
    }

    bool solid_, hides_, crystal_;
    double opacity_, stands_for_;
    std::array<double, kOpacities> plain_{};
    double detail_ = 1;
};

/// Mean of f(diameter in m) over the spectrum: the melted diameter is x / Lambda with probability exp(-x) dx.
template <class Function>
double over_spectrum(const Snow& snow, const Function& f)
{
    const double slope = size_law(snow.spectrum, static_cast<double>(snow.rate_mm_h)).slope;
    double sum = 0, weights = 0;
    for (int i = 0; i < kSizes; ++i)
    {
        const double x = kLargestExponent * (i + 0.5) / kSizes;
        const double melted = x / slope;
        const double flake = std::sqrt(melted * melted * melted / kFlakeDensity);
        const double weight = std::exp(-x);
        sum += weight * f(1e-3 * std::clamp(flake, kSmallestFlake_mm, kLargestFlake_mm));
        weights += weight;
    }
    return sum / weights;
}

double area_at(const SpriteCover& cover, const RenderSettings& render, const Snow& snow, const View& view,
               double depth_m)
{
    const double near_m = view.near_m;
    if (!(depth_m > near_m)) return 0;
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    const double largest_px = std::min(std::round(static_cast<double>(view.guard_px)), kLargestSprite_px);
    return over_spectrum(
        snow,
        [&](double diameter_m)
        {
            const double radius_m = 0.5 * diameter_m * render.flake_scale;
            const SpriteSize<double> size = sprite_size(radius_m, depth_m, focal_px, largest_px, near_m);
            const double side_m = size.radius_px * depth_m / focal_px;
            const double kept = cover.thins_out() ? kept_of_tiny(2 * radius_m * focal_px / depth_m) : 1;
            return side_m * side_m * cover.at(kept * size.opacity, size.radius_px);
        });
}

}  // namespace

double flake_area_m2(const RenderSettings& render, const Snow& snow, const View& view, double depth_m)
{
    return area_at(SpriteCover(render, snow), render, snow, view, depth_m);
}

double flake_cover(const RenderSettings& render, const Snow& snow)
{
    return SpriteCover(render, snow).at(1, kDetailFrom_px);
}

double full_flake_area_m2(const RenderSettings& render, const Snow& snow)
{
    const double cover = flake_cover(render, snow);
    return over_spectrum(snow,
                         [&](double diameter_m)
                         {
                             const double side_m = 0.5 * diameter_m * render.flake_scale;
                             return side_m * side_m * cover;
                         });
}

FlakeShadeTable make_flake_shade(const RenderSettings& render, const Snow& snow, const View& view,
                                 double most_m2)
{
    const SpriteCover cover(render, snow);
    FlakeShadeTable table;
    table.first_log2 = std::log2(static_cast<double>(view.near_m));
    table.entries_per_log2 = (kEntries - 1) / (std::log2(static_cast<double>(view.far_m)) - table.first_log2);
    double depth_m = view.near_m, area = 0, sum = 0;
    for (int i = 0; i < kEntries; ++i)
    {
        for (int k = 0; k < kStepsPerEntry && i > 0; ++k)
        {
            const double next_m =
                std::exp2(table.first_log2 + (i - 1 + (k + 1.0) / kStepsPerEntry) / table.entries_per_log2);
            const double next = std::min(area_at(cover, render, snow, view, next_m), most_m2);
            sum += 0.5 * (area + next) * (next_m - depth_m);
            depth_m = next_m;
            area = next;
        }
        table.area_m2.push_back(area);
        table.integral_m3.push_back(sum);
    }
    return table;
}

}  // namespace spindrift::scene
