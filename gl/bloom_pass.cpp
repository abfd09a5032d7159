// SPDX-License-Identifier: MIT
#include "gl/bloom_pass.h"

#include <array>
#include <cmath>
#include <string>

#include "gl/frame_constants.h"
#include "scene/development.h"

namespace spindrift::gl
{

namespace
{

using scene::BloomMethod;

constexpr GLenum kFormat = GL_RGBA16F;
constexpr GLint kBright = 0;
constexpr GLint kWeights = 0;
constexpr GLint kRadius = 1;

FullScreenPass make_bright(int scale, BloomMethod method)
{
    std::vector<std::string_view> defines;
    if (scale > 1) defines.emplace_back("HALF");
    if (method == BloomMethod::legacy) defines.emplace_back("REPORT");
    return {"develop.vert", "bloom_bright.frag", defines};
}

/// Weight of the middle tap; that of the next over it; the factor by which this ratio falls.
glm::vec3 tap_weights(const BloomShape& shape, BloomMethod method)
{
    if (method == BloomMethod::legacy) return {1.0 / (2 * shape.gauss_radius + 1), 1, 1};
    const double bend = 1 / (shape.gauss_sigma * shape.gauss_sigma);
    return {gaussian_weights(shape.gauss_sigma, shape.gauss_radius).front(), std::exp(-bend / 2),
            std::exp(-bend)};
}

}  // namespace

glm::vec3 bright_uniform(const scene::BloomSettings& settings)
{
    const Bright<double> bright = scene::bright_of(settings);
    return {bright.threshold, bright.threshold * bright.knee, bright.ceiling};
}

BloomPass::BloomPass(const scene::BloomSettings& settings, int width_px, int height_px)
    : settings_(settings),
      width_px_(width_px),
      height_px_(height_px),
      shape_(bloom_shape(settings, height_px)),
      dark_outside_(make_linear_sampler(GL_CLAMP_TO_BORDER)),
      to_the_edge_(make_linear_sampler(GL_CLAMP_TO_EDGE)),
      bright_(make_bright(shape_.first_scale, settings.method)),
      first_(&target(shape_.first_scale, shape_.first_scale)),
      spread_(first_),
      spread_scale_(shape_.first_scale),
      command_(make_buffer(sizeof(GLuint) * 4, nullptr, GL_DYNAMIC_STORAGE_BIT))
{
    const glm::vec3 bright = bright_uniform(settings);
    glProgramUniform3f(bright_.program(), kBright, bright.x, bright.y, bright.z);
    if (settings.method == BloomMethod::reduced) add_reduction();
    if (settings.method == BloomMethod::pyramid || settings.method == BloomMethod::dual)
        add_pyramid();
    else
        add_gauss();
}

const FullScreenPass& BloomPass::program(std::string_view fragment_file,
                                         std::span<const std::string_view> defines)
{
    return programs_.emplace_back("full_screen.vert", fragment_file, defines);
}

const FloatTarget& BloomPass::target(int scale_x, int scale_y)
{
    return targets_.emplace_back(kFormat, (width_px_ + scale_x - 1) / scale_x,
                                 (height_px_ + scale_y - 1) / scale_y);
}

void BloomPass::add(const FullScreenPass& pass, const FloatTarget& to, GLuint sampler)
{
    steps_.push_back({&pass, spread_, &to, sampler});
    spread_ = &to;
}

void BloomPass::add_gauss()
{
    if (shape_.gauss_radius == 0) return;
    const FloatTarget& to = *spread_;
    const glm::vec3 weights = tap_weights(shape_, settings_.method);
    const auto axis = [&](std::span<const std::string_view> defines, const FloatTarget& target_of_axis)
    {
        const FullScreenPass& pass = program("bloom_gauss.frag", defines);
        glProgramUniform3f(pass.program(), kWeights, weights.x, weights.y, weights.z);
        glProgramUniform1i(pass.program(), kRadius, shape_.gauss_radius);
        add(pass, target_of_axis);
    };
    axis({}, target(shape_.scale, shape_.scale));
    axis(std::array<std::string_view, 1>{"ALONG_Y"}, to);
}

void BloomPass::add_reduction()
{
    if (shape_.scale == shape_.first_scale) return;
    const std::string factor = "FACTOR " + std::to_string(shape_.scale / shape_.first_scale);
    add(program("bloom_tent.frag", std::array<std::string_view, 1>{factor}),
        target(shape_.scale, shape_.first_scale));
    add(program("bloom_tent.frag", std::array<std::string_view, 2>{factor, "ALONG_Y"}),
        target(shape_.scale, shape_.scale));
    spread_scale_ = shape_.scale;
}

void BloomPass::add_pyramid()
{
    const bool dual = settings_.method == BloomMethod::dual;
    std::vector<const FloatTarget*> levels{first_};
    const FullScreenPass& down = program(dual ? "bloom_dual_down.frag" : "bloom_down13.frag");
    for (int level = 1; level <= shape_.levels; ++level)
    {
        levels.push_back(&target(2 << level, 2 << level));
        add(down, *levels.back(), dark_outside_.name());
    }
    add_gauss();
    const FullScreenPass& up = program(dual ? "bloom_dual_up.frag" : "bloom_tent_up.frag");
    for (int level = shape_.levels; level > 0; --level)
        add(up, *levels[static_cast<std::size_t>(level) - 1], to_the_edge_.name());
}

void BloomPass::draw(GLuint linear) const
{
    constexpr std::array<GLuint, 4> kNothingYet{0, 1, 0, 0};  // DrawArraysIndirectCommand
    glNamedBufferSubData(command_.name(), 0, sizeof(kNothingYet), kNothingYet.data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kBloomCommandWritten, command_.name());
    glDisable(GL_DEPTH_TEST);
    first_->bind();
    glBindTextureUnit(0, linear);
    bright_.draw();
    glMemoryBarrier(GL_COMMAND_BARRIER_BIT | GL_UNIFORM_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
    for (const Step& step : steps_)
    {
        step.to->bind();
        glBindTextureUnit(0, step.from->texture.name());
        glBindSampler(0, step.sampler);
        step.pass->draw_commanded(command_.name());
    }
    glBindSampler(0, 0);
}

bool BloomPass::found_bright() const
{
    GLuint vertices = 0;
    glGetNamedBufferSubData(command_.name(), 0, sizeof(vertices), &vertices);
    return vertices != 0;
}

}  // namespace spindrift::gl
