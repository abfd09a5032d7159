// SPDX-License-Identifier: MIT
#include "tests/gl/darkroom.h"

#include <gtest/gtest.h>

#include "core/tone.h"
#include "gl/bloom_pass.h"
#include "gl/context.h"
#include "gl/exposure_pass.h"
#include "gl/float_target.h"
#include "gl/tone_pass.h"
#include "tests/gl/stage.h"

namespace spindrift::gl
{

namespace
{

void develop_into(const Darkroom& room, const FloatTarget& target)
{
    const image::Image& light = room.light;
    const Texture linear = make_texture_2d(GL_RGBA32F, light.width, light.height);
    glTextureSubImage2D(linear.name(), 0, 0, 0, light.width, light.height, GL_RGBA, GL_FLOAT,
                        light.rgba.data());
    ExposurePass exposure(room.scene.render, light.width, light.height);
    if (room.scene.render.auto_exposure) exposure.draw(linear.name(), room.time_s);
    exposure.bind();
    const BloomPass bloom(room.scene.bloom, light.width, light.height);
    const bool blooms = room.scene.bloom.weight > 0;
    if (blooms) bloom.draw(linear.name());
    target.bind();
    TonePass(room.scene).draw(linear.name(), blooms ? &bloom : nullptr);
    room.found_bright = blooms && bloom.found_bright();
    room.exposure = exposure.exposure();
}

}  // namespace

Darkroom::Darkroom(int width, int height) : light(width, height)
{
    scene.display.dither = false;
}

void Darkroom::set(int x, int y, float red, float green, float blue)
{
    float* p = light.pixel(x, y);
    p[0] = red;
    p[1] = green;
    p[2] = blue;
    p[3] = 1;
}

void Darkroom::fill(float grey)
{
    for (int y = 0; y < light.height; ++y)
        for (int x = 0; x < light.width; ++x) set(x, y, grey, grey, grey);
}

image::Image Darkroom::spread() const
{
    Darkroom room = *this;
    constexpr double kMost = 1000;  // shown as white
    room.scene.bloom.weight = 1;
    room.scene.bloom.threshold = room.scene.bloom.knee = 0;
    room.scene.display.tone = ToneCurve::calibrated;
    room.scene.display.unit_cd_m2 = 1;
    room.scene.display.white_cd_m2 = kMost;
    image::Image out = room.shown();
    for (float& value : out.rgba) value = static_cast<float>(kMost * srgb_decoded(double{value}));
    return out;
}

image::Image Darkroom::shown() const
{
    test_context();
    const std::string errors_before = Context::debug_errors();
    const FloatTarget target(GL_RGBA32F, light.width, light.height);
    develop_into(*this, target);
    image::Image out(light.width, light.height);
    glGetTextureImage(target.texture.name(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(out.rgba.size() * 4),
                      out.rgba.data());
    EXPECT_EQ(Context::debug_errors(), errors_before);
    return out;
}

image::Image8 Darkroom::shown8() const
{
    test_context();
    const FloatTarget target(GL_RGBA8, light.width, light.height);
    develop_into(*this, target);
    std::vector<unsigned char> rgba(light.rgba.size());
    glGetTextureImage(target.texture.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE, static_cast<GLsizei>(rgba.size()),
                      rgba.data());
    image::Image8 out{light.width, light.height, {}};
    for (std::size_t i = 0; i < rgba.size(); ++i)
        if (i % 4 < 3) out.rgb.push_back(rgba[i]);
    return out;
}

}  // namespace spindrift::gl
