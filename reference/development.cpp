// SPDX-License-Identifier: MIT
#include "reference/development.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "core/bloom.h"
#include "core/exposure.h"
#include "core/light.h"
#include "core/tone.h"
#include "scene/development.h"

namespace spindrift::reference
{

namespace
{

Vec3d light_at(const image::Image& picture, int x, int y)
{
    const float* p = picture.pixel(x, y);
    return contained(Vec3d{double{p[0]}, double{p[1]}, double{p[2]}});
}

void set(image::Image& picture, int x, int y, const Vec3d& light)
{
    float* p = picture.pixel(x, y);
    p[0] = static_cast<float>(light.x);
    p[1] = static_cast<float>(light.y);
    p[2] = static_cast<float>(light.z);
    p[3] = 1;
}

/// One axis: `step` is (1, 0) or (0, 1).
image::Image blurred(const image::Image& picture, const std::vector<double>& weights, int step_x, int step_y)
{
    image::Image out(picture.width, picture.height);
    const int radius = static_cast<int>(weights.size()) - 1;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
        {
            const int place = step_x * x + step_y * y;
            const int last = step_x * picture.width + step_y * picture.height - 1;
            Vec3d sum{0, 0, 0};
            for (int i = std::max(-radius, -place); i <= std::min(radius, last - place); ++i)
                sum = sum + light_at(picture, x + i * step_x, y + i * step_y) *
                                weights[static_cast<std::size_t>(std::abs(i))];
            set(out, x, y, sum);
        }
    return out;
}

}  // namespace

double exposure_of(const image::Image& linear, const scene::RenderSettings& render)
{
    if (!render.auto_exposure) return render.exposure;
    double sum = 0;
    for (int y = 0; y < linear.height; ++y)
        for (int x = 0; x < linear.width; ++x) sum += log_luminance(luminance(light_at(linear, x, y)));
    return exp2(wanted_log_exposure(sum / (static_cast<double>(linear.width) * linear.height), render.grey));
}

image::Image bright_picture(const image::Image& linear, double exposure, const scene::BloomSettings& bloom)
{
    image::Image out(linear.width, linear.height);
    for (int y = 0; y < linear.height; ++y)
        for (int x = 0; x < linear.width; ++x)
        {
            const Vec3d light = light_at(linear, x, y) * exposure;
            set(out, x, y,
                bloom.method == scene::BloomMethod::legacy
                    ? report_bright_part(light, scene::bright_of(bloom))
                    : bright_part(light, scene::bright_of(bloom)));
        }
    return out;
}

image::Image exact_gaussian(const image::Image& picture, double sigma_px)
{
    const std::vector<double> weights = gaussian_weights(sigma_px, static_cast<int>(std::ceil(6 * sigma_px)));
    return blurred(blurred(picture, weights, 1, 0), weights, 0, 1);
}

image::Image8 develop(const image::Image& linear, const scene::Scene& scene)
{
    const double exposure = exposure_of(linear, scene.render);
    const Tone<double> tone = scene::tone_of(scene);
    const bool blooms = scene.bloom.weight > 0;
    const image::Image bright = bright_picture(linear, exposure, scene.bloom);
    const image::Image spread =
        blooms ? exact_gaussian(bright, scene::bloom_sigma_px(scene.bloom, linear.height)) : bright;
    image::Image8 out{linear.width, linear.height, {}};
    for (int y = 0; y < linear.height; ++y)
        for (int x = 0; x < linear.width; ++x)
        {
            const Vec3d moved = (light_at(spread, x, y) - light_at(bright, x, y)) * scene.bloom.weight;
            const Vec3d shown = tone_mapped(light_at(linear, x, y) * exposure + moved, tone);
            for (const double channel : {shown.x, shown.y, shown.z})
                out.rgb.push_back(static_cast<unsigned char>(std::lround(255 * srgb_encoded(channel))));
        }
    return out;
}

}  // namespace spindrift::reference
