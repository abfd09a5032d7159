// SPDX-License-Identifier: MIT
#include "gl/exposure_pass.h"

#include <array>
#include <cmath>

#include "core/exposure.h"
#include "gl/frame_constants.h"

namespace spindrift::gl
{

namespace
{

constexpr int kBlockPx = 32;  // of meter.frag

FloatTarget make_blocks(int width_px, int height_px)
{
    return {GL_RG32F, (width_px + kBlockPx - 1) / kBlockPx, (height_px + kBlockPx - 1) / kBlockPx};
}

}  // namespace

ExposurePass::ExposurePass(const scene::RenderSettings& settings, int width_px, int height_px)
    : settings_(settings),
      meter_("full_screen.vert", "meter.frag"),
      expose_("full_screen.vert", "expose.frag"),
      blocks_(make_blocks(width_px, height_px)),
      nowhere_(GL_R32F, 1, 1)
{
    const auto exposure = static_cast<float>(settings.exposure);
    const std::array<float, 4> block{exposure, std::log2(exposure), 0, 0};
    block_ = make_buffer(sizeof(block), block.data(), 0);
}

void ExposurePass::resize(int width_px, int height_px)
{
    blocks_ = make_blocks(width_px, height_px);
}

void ExposurePass::draw(GLuint linear, double time_s)
{
    const bool follows = last_time_s_ && time_s >= *last_time_s_;
    const double share = follows ? adapted_share(time_s - *last_time_s_, settings_.adaptation_s) : 1;
    last_time_s_ = time_s;
    glDisable(GL_DEPTH_TEST);
    blocks_.bind();
    glBindTextureUnit(0, linear);
    meter_.draw();
    nowhere_.bind();
    glBindTextureUnit(0, blocks_.texture.name());
    glProgramUniform2f(expose_.program(), 0, static_cast<float>(std::log2(settings_.grey)),
                       static_cast<float>(share));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kExposureWritten, block_.name());
    expose_.draw();
    glMemoryBarrier(GL_UNIFORM_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
}

void ExposurePass::bind() const
{
    glBindBufferBase(GL_UNIFORM_BUFFER, kExposure, block_.name());
}

double ExposurePass::exposure() const
{
    float factor = 0;
    glGetNamedBufferSubData(block_.name(), 0, sizeof(factor), &factor);
    return factor;
}

}  // namespace spindrift::gl
