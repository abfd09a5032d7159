// SPDX-License-Identifier: MIT
#include "gl/tile_pass.h"

#include <cmath>
#include <glm/gtc/packing.hpp>

#include "gl/flake_look.h"
#include "scene/air.h"
#include "scene/crystals.h"
#include "scene/development.h"

namespace spindrift::gl
{

namespace
{

/// All masks in one array, level by level.
std::vector<std::uint8_t> gather_texels(const std::vector<scene::CrystalMask>& masks, CrystalTexels& out)
{
    std::vector<std::uint8_t> texels;
    out.shapes = static_cast<std::uint32_t>(masks.size());
    const std::size_t levels = masks.front().levels.size();
    out.size_log2 = static_cast<int>(levels) - 1;
    for (std::size_t level = 0; level < levels; ++level)
    {
        out.level_start[level] = static_cast<std::int32_t>(texels.size());
        for (const scene::CrystalMask& mask : masks)
            texels.insert(texels.end(), mask.levels[level].begin(), mask.levels[level].end());
    }
    for (std::size_t i = 0; i < masks.size(); ++i) out.means[i] = static_cast<float>(masks[i].mean);
    texels.resize(texels.size() + 3);
    out.texels = texels.data();
    return texels;
}

/// Display level of every half float from +0 to the last NaN, in 1/256.
std::vector<std::uint16_t> tone_table(const scene::Scene& scene)
{
    const Tone<double> tone = scene::tone_of(scene);
    std::vector<std::uint16_t> table(0x8000);
    for (std::size_t half = 0; half < table.size(); ++half)
    {
        const double light = glm::unpackHalf1x16(static_cast<glm::uint16>(half));
        const double exposed = scene.render.exposure * contained(Vec3d{light, light, light}).x;
        const double shown = srgb_encoded(tone_mapped(Vec3d{exposed, exposed, exposed}, tone).x);
        table[half] = static_cast<std::uint16_t>(std::lround(shown * 255 * 256));
    }
    return table;
}

/// What is added to each pixel's levels before they are cut, in 1/256: rounding, or the noise of tone.frag.
std::vector<std::uint8_t> level_noise(const Picture& picture, bool dither)
{
    std::vector<std::uint8_t> noise(
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height), 128);
    if (!dither) return noise;
    const auto fraction = [](float x) { return x - std::floor(x); };
    std::size_t i = 0;
    for (int y = 0; y < picture.height; ++y)
        for (int x = 0; x < picture.width; ++x)
        {
            const float along =
                0.06711056F * (static_cast<float>(x) + 0.5F) + 0.00583715F * (static_cast<float>(y) + 0.5F);
            noise[i++] = static_cast<std::uint8_t>(256 * fraction(52.9829189F * fraction(along)));
        }
    return noise;
}

SplatBlending splat_blending(scene::Blending blending)
{
    switch (blending)
    {
        case scene::Blending::additive:
            return SplatBlending::additive;
        case scene::Blending::weighted:
            return SplatBlending::weighted;
        case scene::Blending::stochastic:
            return SplatBlending::stochastic;
        case scene::Blending::over:
        case scene::Blending::opaque:  // never in tiles
            break;
    }
    return SplatBlending::over;
}

}  // namespace

TilePass::TilePass(const scene::Scene& scene, const World& world, const FlakeBuffers& buffers)
    : settings_(scene.render),
      sizes_(world.snow, world.seed),
      real_flakes_(world.snow.weight /
                   static_cast<float>(scene.render.flake_scale * scene.render.flake_scale)),
      extinction_per_m_(static_cast<float>(scene::flake_extinction(scene))),
      buffers_(buffers),
      texels_(gather_texels(scene::crystal_masks(), crystals_)),
      dither_(scene.display.dither),
      tone_(tone_table(scene))
{
}

SplatJob TilePass::job(const Frame& frame) const
{
    SplatJob job;
    job.view = frame.view;
    job.largest_px = sprite_limits(frame.view).largest_px;
    job.time_s = frame.time_s;
    job.sizes = sizes_;
    job.flake_scale = static_cast<float>(settings_.flake_scale);
    job.flake_opacity = static_cast<float>(settings_.flake_opacity);
    job.real_flakes = real_flakes_;
    job.plain_discs = settings_.sprite == scene::Sprite::point;
    job.blending = splat_blending(settings_.blending);
    job.samples = settings_.samples;
    job.extinction_per_m = extinction_per_m_;
    job.ambient = frame.ambient;
    job.air = frame.air;
    job.lamps = frame.lamps.data();
    job.lamp_count = frame.lamps.size();
    job.shadows = frame.shadows;
    job.clusters = frame.clusters;
    job.glow = frame.glow;
    job.crystals = crystals_;
    job.flakes = buffers_.flakes();
    const DrawListView lists = buffers_.draw_list();
    job.pairs = frame.list.in_scratch ? lists.scratch : lists.pairs;
    job.count = frame.list.count;
    job.shutter_s = static_cast<float>(settings_.shutter_s);
    job.velocities = frame.velocities;
    return job;
}

SplatPicture TilePass::fetch(const Picture& picture)
{
    const std::size_t pixels =
        static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    depth_.resize(pixels);
    rgba_.resize(pixels * 4);
    glGetTextureImage(picture.depth.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, static_cast<GLsizei>(pixels * 4),
                      depth_.data());
    glGetTextureImage(picture.linear.name(), 0, GL_RGBA, GL_HALF_FLOAT, static_cast<GLsizei>(pixels * 8),
                      rgba_.data());
    return {picture.width, picture.height, depth_.data(), rgba_.data(), nullptr, nullptr, nullptr};
}

void TilePass::blend(Splatter& splatter, const Frame& frame, const Picture& picture)
{
    splatter.splat(job(frame), fetch(picture));
    holds_light_ = true;
    bring_back(picture);
}

void TilePass::blend_and_develop(Splatter& splatter, const Frame& frame, const Picture& picture)
{
    SplatPicture target = fetch(picture);
    if (display_.size() != rgba_.size() || noise_width_ != picture.width)
        noise_ = level_noise(picture, dither_);
    noise_width_ = picture.width;
    display_.resize(rgba_.size());
    target.tone = tone_.data();
    target.noise = noise_.data();
    target.display = display_.data();
    splatter.splat(job(frame), target);
    glTextureSubImage2D(picture.display.name(), 0, 0, 0, picture.width, picture.height, GL_RGBA,
                        GL_UNSIGNED_BYTE, display_.data());
    holds_light_ = true;
}

void TilePass::bring_back(const Picture& picture)
{
    if (!holds_light_) return;
    glTextureSubImage2D(picture.linear.name(), 0, 0, 0, picture.width, picture.height, GL_RGBA, GL_HALF_FLOAT,
                        rgba_.data());
    holds_light_ = false;
}

}  // namespace spindrift::gl
