// SPDX-License-Identifier: MIT
#include "image/flip.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/tone.h"
#include "core/vec.h"
#include "image/compare.h"

namespace spindrift::image
{

namespace
{

/// Three channels of a picture, or one in x.
struct Plane
{
    int width, height;
    std::vector<Vec3d> pixels;

    /// Beyond the border its pixels go on.
    const Vec3d& at(int x, int y) const
    {
        x = std::clamp(x, 0, width - 1);
        y = std::clamp(y, 0, height - 1);
        return pixels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
    template <class Call>
    Plane each(const Call& call) const
    {
        Plane out{width, height, pixels};
        for (Vec3d& pixel : out.pixels) pixel = call(pixel);
        return out;
    }
};

Vec3d product(const Vec3d& a, const Vec3d& b)
{
    return {a.x * b.x, a.y * b.y, a.z * b.z};
}

// Linear Rec.709 and CIE XYZ, both relative to the white of D65.

constexpr Vec3d kWhite{0.950428545, 1.0, 1.088900371};

Vec3d xyz_over_white(const Vec3d& rgb)
{
    const Vec3d xyz{0.4123907993 * rgb.x + 0.3575843394 * rgb.y + 0.1804807884 * rgb.z,
                    0.2126390059 * rgb.x + 0.7151686788 * rgb.y + 0.0721923154 * rgb.z,
                    0.0193308187 * rgb.x + 0.1191947798 * rgb.y + 0.9505321522 * rgb.z};
    return {xyz.x / kWhite.x, xyz.y / kWhite.y, xyz.z / kWhite.z};
}

Vec3d rgb_of(const Vec3d& over_white)
{
    const Vec3d xyz = product(over_white, kWhite);
    return {3.2409699419 * xyz.x - 1.5373831776 * xyz.y - 0.4986107603 * xyz.z,
            -0.9692436363 * xyz.x + 1.8759675015 * xyz.y + 0.0415550574 * xyz.z,
            0.0556300797 * xyz.x - 0.2039769589 * xyz.y + 1.0569715142 * xyz.z};
}

/// The linear opponent space in which the eye's blur is applied.
Vec3d opponent(const Vec3d& rgb)
{
    const Vec3d w = xyz_over_white(rgb);
    return {116 * w.y - 16, 500 * (w.x - w.y), 200 * (w.y - w.z)};
}

Vec3d rgb_of_opponent(const Vec3d& c)
{
    const double y = (c.x + 16) / 116;
    return rgb_of({y + c.y / 500, y, y - c.z / 200});
}

/// CIE L*a*b*, with chroma that fades with the lightness (Hunt's effect).
Vec3d hunt_lab(const Vec3d& rgb)
{
    const auto root = [](double t)
    {
        constexpr double knee = 6.0 / 29;
        return t > knee * knee * knee ? std::cbrt(t) : t / (3 * knee * knee) + 4.0 / 29;
    };
    const Vec3d w = xyz_over_white(rgb);
    const double l = 116 * root(w.y) - 16;
    const double a = 500 * (root(w.x) - root(w.y)), b = 200 * (root(w.y) - root(w.z));
    return {l, 0.01 * l * a, 0.01 * l * b};
}

double hyab(const Vec3d& a, const Vec3d& b)
{
    return std::abs(a.x - b.x) + std::hypot(a.y - b.y, a.z - b.z);
}

/// Square weights round a pixel; each channel has its own.
struct Kernel
{
    int radius;
    std::vector<Vec3d> weights;

    template <class Weight>
    Kernel(int r, const Weight& weight) : radius(r)
    {
        for (int y = -r; y <= r; ++y)
            for (int x = -r; x <= r; ++x) weights.push_back(weight(x, y));
    }
    Vec3d over(const Plane& plane, int x, int y) const
    {
        Vec3d sum{0, 0, 0};
        std::size_t i = 0;
        for (int dy = -radius; dy <= radius; ++dy)
            for (int dx = -radius; dx <= radius; ++dx)
                sum = sum + product(weights[i++], plane.at(x + dx, y + dy));
        return sum;
    }
    Plane over(const Plane& plane) const
    {
        Plane out{plane.width, plane.height, {}};
        for (int y = 0; y < plane.height; ++y)
            for (int x = 0; x < plane.width; ++x) out.pixels.push_back(over(plane, x, y));
        return out;
    }
};

/// What the eye still resolves of lightness, red-green and blue-yellow: sums of Gaussians, a sqrt(pi / b)
/// exp(-(pi x)² / b) over degrees, normalised.
Kernel contrast_sensitivity(double pixels_per_degree)
{
    struct Term
    {
        double a, b;
    };
    constexpr std::array<std::array<Term, 2>, 3> channels{
        {{{{1, 0.0047}, {0, 1e-5}}}, {{{1, 0.0053}, {0, 1e-5}}}, {{{34.1, 0.04}, {13.5, 0.025}}}}};
    constexpr double pi = std::numbers::pi, widest = 0.04;
    const int radius = static_cast<int>(std::ceil(3 * std::sqrt(widest / (2 * pi * pi)) * pixels_per_degree));
    const auto value = [&](std::size_t channel, int x, int y)
    {
        const double degrees2 = (x * x + y * y) / (pixels_per_degree * pixels_per_degree);
        double sum = 0;
        for (const Term& term : channels[channel])
            sum += term.a * std::sqrt(pi / term.b) * std::exp(-pi * pi * degrees2 / term.b);
        return sum;
    };
    Kernel kernel(radius,
                  [&](int x, int y) {
                      return Vec3d{value(0, x, y), value(1, x, y), value(2, x, y)};
                  });
    Vec3d all{0, 0, 0};
    for (const Vec3d& weight : kernel.weights) all = all + weight;
    for (Vec3d& weight : kernel.weights) weight = {weight.x / all.x, weight.y / all.y, weight.z / all.z};
    return kernel;
}

constexpr double kFeatureWidth_deg = 0.082;

/// First (`order` 1: edges) or second (2: points) derivative of a Gaussian along x in channel x and along y
/// in channel y; weights of either sign add up to 1.
Kernel feature_kernel(int order, double pixels_per_degree)
{
    const double sigma = 0.5 * kFeatureWidth_deg * pixels_per_degree;
    const auto along = [&](int t, int x, int y)
    {
        const double gauss = std::exp(-(x * x + y * y) / (2 * sigma * sigma));
        return (order == 1 ? -t : t * t / (sigma * sigma) - 1) * gauss;
    };
    Kernel kernel(static_cast<int>(std::ceil(3 * sigma)),
                  [&](int x, int y) {
                      return Vec3d{along(x, x, y), along(y, x, y), 0};
                  });
    double up = 0, down = 0;
    for (const Vec3d& weight : kernel.weights)
    {
        up += std::max(weight.x, 0.0);
        down -= std::min(weight.x, 0.0);
    }
    const auto scaled = [&](double weight) { return weight / (weight > 0 ? up : down); };
    for (Vec3d& weight : kernel.weights) weight = {scaled(weight.x), scaled(weight.y), 0};
    return kernel;
}

Plane linear_light(const Image8& image)
{
    static const std::array<double, 256> levels = []
    {
        std::array<double, 256> linear{};
        for (std::size_t i = 0; i < 256; ++i) linear[i] = srgb_decoded(static_cast<double>(i) / 255);
        return linear;
    }();
    Plane plane{image.width, image.height, {}};
    for (std::size_t i = 0; i + 2 < image.rgb.size(); i += 3)
        plane.pixels.push_back({levels[image.rgb[i]], levels[image.rgb[i + 1]], levels[image.rgb[i + 2]]});
    return plane;
}

Plane as_seen(const Plane& opponents, const Kernel& eye)
{
    return eye.over(opponents).each(
        [](const Vec3d& c)
        {
            const Vec3d rgb = rgb_of_opponent(c);
            return hunt_lab(
                {std::clamp(rgb.x, 0.0, 1.0), std::clamp(rgb.y, 0.0, 1.0), std::clamp(rgb.z, 0.0, 1.0)});
        });
}

constexpr double kColourPower = 0.7;

/// A colour difference on a scale from 0 to 1: the lower two fifths of what can be take 0.95 of it.
double scaled_difference(const Vec3d& a, const Vec3d& b)
{
    static const double most = std::pow(hyab(hunt_lab({0, 1, 0}), hunt_lab({0, 0, 1})), kColourPower);
    constexpr double knee = 0.4, at_knee = 0.95;
    const double off = std::pow(hyab(a, b), kColourPower), limit = knee * most;
    return off < limit ? at_knee / limit * off : at_knee + (off - limit) / (most - limit) * (1 - at_knee);
}

/// Channel x: strength of edges, y: of points.
Plane features(const Plane& opponents, double pixels_per_degree)
{
    const Plane light = opponents.each(
        [](const Vec3d& c)
        {
            const double y = (c.x + 16) / 116;
            return Vec3d{y, y, 0};
        });
    const Plane edges = feature_kernel(1, pixels_per_degree).over(light);
    Plane out = feature_kernel(2, pixels_per_degree).over(light);
    for (std::size_t i = 0; i < out.pixels.size(); ++i)
        out.pixels[i] = {std::hypot(edges.pixels[i].x, edges.pixels[i].y),
                         std::hypot(out.pixels[i].x, out.pixels[i].y), 0};
    return out;
}

double feature_difference(const Vec3d& a, const Vec3d& b)
{
    constexpr double power = 0.5;
    return std::pow(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) / std::numbers::sqrt2, power);
}

}  // namespace

std::vector<float> flip_map(const Image8& a, const Image8& b, double pixels_per_degree)
{
    require_same_size(a.width, a.height, b.width, b.height);
    const Kernel eye = contrast_sensitivity(pixels_per_degree);
    const Plane first = linear_light(a).each(opponent), second = linear_light(b).each(opponent);
    const Plane seen_first = as_seen(first, eye), seen_second = as_seen(second, eye);
    const Plane features_first = features(first, pixels_per_degree),
                features_second = features(second, pixels_per_degree);
    std::vector<float> map;
    for (std::size_t i = 0; i < first.pixels.size(); ++i)
    {
        const double colour = scaled_difference(seen_first.pixels[i], seen_second.pixels[i]);
        const double feature =
            std::min(feature_difference(features_first.pixels[i], features_second.pixels[i]), 1.0);
        map.push_back(static_cast<float>(std::pow(colour, 1 - feature)));
    }
    return map;
}

double flip(const Image8& a, const Image8& b, double pixels_per_degree)
{
    const std::vector<float> map = flip_map(a, b, pixels_per_degree);
    double sum = 0;
    for (const float value : map) sum += double{value};
    return map.empty() ? 0 : sum / static_cast<double>(map.size());
}

}  // namespace spindrift::image
