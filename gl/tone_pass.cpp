// SPDX-License-Identifier: MIT
#include "gl/tone_pass.h"

#include <string>
#include <string_view>
#include <vector>

#include "gl/frame_constants.h"
#include "scene/development.h"

namespace spindrift::gl
{

namespace
{

constexpr GLint kBright = 0;
constexpr GLint kTone = 1;
constexpr GLint kMixing = 2;

std::string_view curve_define(ToneCurve curve)
{
    switch (curve)
    {
        case ToneCurve::reinhard:
            return "TONE tone_reinhard";
        case ToneCurve::aces:
            return "TONE tone_aces";
        case ToneCurve::agx:
            return "TONE tone_agx";
        case ToneCurve::neutral:
            return "TONE tone_neutral";
        case ToneCurve::linear:
        case ToneCurve::calibrated:
        case ToneCurve::legacy:
            break;
    }
    return "TONE tone_affine";
}

}  // namespace

TonePass::TonePass(const scene::Scene& scene)
    : bloom_(scene.bloom),
      tone_(scene::tone_of(scene)),
      dither_(scene.display.dither),
      sampler_(make_linear_sampler(GL_CLAMP_TO_EDGE))
{
}

const FullScreenPass& TonePass::variant(bool blooms) const
{
    std::optional<FullScreenPass>& variant = variants_[blooms ? 1 : 0];
    if (variant) return *variant;
    std::vector<std::string_view> defines{curve_define(tone_.curve)};
    if (blooms) defines.emplace_back("BLOOM");
    if (blooms && bloom_.method == scene::BloomMethod::legacy) defines.emplace_back("REPORT");
    if (dither_) defines.emplace_back("DITHER");
    variant.emplace("develop.vert", "tone.frag", defines);
    const glm::vec3 bright = bright_uniform(bloom_);
    glProgramUniform3f(variant->program(), kBright, bright.x, bright.y, bright.z);
    glProgramUniform3f(variant->program(), kTone, static_cast<float>(tone_.white),
                       static_cast<float>(tone_.scale), static_cast<float>(tone_.offset));
    return *variant;
}

void TonePass::draw(GLuint linear, const BloomPass* bloom) const
{
    const FullScreenPass& pass = variant(bloom != nullptr);
    glDisable(GL_DEPTH_TEST);
    glBindTextureUnit(0, linear);
    if (bloom != nullptr)
    {
        const FloatTarget& spread = bloom->spread();
        glBindTextureUnit(1, spread.texture.name());
        glBindSampler(1, sampler_.name());
        glBindBufferBase(GL_UNIFORM_BUFFER, kBloomCommand, bloom->command());
        glProgramUniform3f(pass.program(), kMixing, static_cast<float>(bloom_.weight),
                           static_cast<float>(1 / (bloom->spread_scale() * spread.width)),
                           static_cast<float>(1 / (bloom->spread_scale() * spread.height)));
    }
    pass.draw();
    glBindSampler(1, 0);
}

}  // namespace spindrift::gl
