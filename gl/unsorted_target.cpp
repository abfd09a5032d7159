// SPDX-License-Identifier: MIT
#include "gl/unsorted_target.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

#include "gl/frame_constants.h"

namespace spindrift::gl
{

namespace
{

Texture make_sampled_texture(GLenum format, int width, int height, int samples)
{
    GLuint name = 0;
    glCreateTextures(GL_TEXTURE_2D_MULTISAMPLE, 1, &name);
    Texture texture(name);
    glTextureStorage2DMultisample(name, samples, format, width, height, GL_TRUE);
    return texture;
}

/// A power of two, so that it divides what is asked for.
int most_samples()
{
    GLint colour = 0, depth = 0;
    glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &colour);
    glGetIntegerv(GL_MAX_DEPTH_TEXTURE_SAMPLES, &depth);
    int most = 1;
    while (2 * most <= std::min(colour, depth)) most *= 2;
    return most;
}

std::vector<std::string_view> compose_defines(scene::Blending blending)
{
    if (blending == scene::Blending::weighted) return {"SHARED"};
    return {};
}

void clear(GLuint framebuffer, GLint buffer, float value)
{
    const std::array<float, 4> all{value, value, value, value};
    glClearNamedFramebufferfv(framebuffer, GL_COLOR, buffer, all.data());
}

}  // namespace

UnsortedTarget::UnsortedTarget(const scene::RenderSettings& settings, const Picture& picture)
    : width_(picture.width),
      height_(picture.height),
      // Sums of up to 6e4 each: more than half floats hold.
      sum_(make_texture_2d(GL_RGBA32F, picture.width, picture.height)),
      target_(make_framebuffer()),
      compose_("full_screen.vert", "unsorted_compose.frag", compose_defines(settings.blending))
{
    if (settings.blending == scene::Blending::weighted)
    {
        attach_shared(picture);
        return;
    }
    samples_ = settings.samples;
    samples_a_pass_ = std::min(samples_, most_samples());
    attach_sampled(picture);
}

void UnsortedTarget::attach_shared(const Picture& picture)
{
    left_ = make_texture_2d(GL_R32F, width_, height_);
    const GLuint target = target_.name();
    glNamedFramebufferTexture(target, GL_COLOR_ATTACHMENT0, sum_.name(), 0);
    glNamedFramebufferTexture(target, GL_COLOR_ATTACHMENT1, left_.name(), 0);
    glNamedFramebufferTexture(target, GL_DEPTH_ATTACHMENT, picture.depth.name(), 0);
    constexpr std::array<GLenum, 2> both{GL_COLOR_ATTACHMENT0, GL_COLOR_ATTACHMENT1};
    glNamedFramebufferDrawBuffers(target, 2, both.data());
    require_complete(target_, "weighted flakes");
}

void UnsortedTarget::attach_sampled(const Picture& picture)
{
    flakes_ = make_sampled_texture(GL_RGBA16F, picture.width, picture.height, samples_a_pass_);
    flakes_depth_ =
        make_sampled_texture(GL_DEPTH_COMPONENT32F, picture.width, picture.height, samples_a_pass_);
    glNamedFramebufferTexture(target_.name(), GL_COLOR_ATTACHMENT0, flakes_.name(), 0);
    glNamedFramebufferTexture(target_.name(), GL_DEPTH_ATTACHMENT, flakes_depth_.name(), 0);
    require_complete(target_, "sampled flakes");
    sum_target_ = make_framebuffer();
    glNamedFramebufferTexture(sum_target_.name(), GL_COLOR_ATTACHMENT0, sum_.name(), 0);
    require_complete(sum_target_, "sum of samples");
    clear(sum_target_.name(), 0, 0);
    depth_.emplace("full_screen.vert", "unsorted_depth.frag");
    add_.emplace("full_screen.vert", "unsorted_sum.frag");
}

void UnsortedTarget::begin(const Picture& picture) const
{
    glBindFramebuffer(GL_FRAMEBUFFER, target_.name());
    glViewport(0, 0, width_, height_);
    clear(target_.name(), 0, 0);
    if (!sampled()) return clear(target_.name(), 1, 1);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glDepthFunc(GL_ALWAYS);
    glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
    glBindTextureUnit(kSceneDepth, picture.depth_copy.name());
    depth_->draw();
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
}

void UnsortedTarget::end() const
{
    if (!sampled()) return;
    glBindFramebuffer(GL_FRAMEBUFFER, sum_target_.name());
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE);
    glBindTextureUnit(kSceneDepth, flakes_.name());
    glProgramUniform2i(add_->program(), 0, samples_a_pass_, samples_);
    add_->draw();
    glDisable(GL_BLEND);
}

void UnsortedTarget::compose(const Picture& picture) const
{
    glBindFramebuffer(GL_FRAMEBUFFER, picture.linear_target.name());
    glDisable(GL_DEPTH_TEST);
    glDepthMask(GL_FALSE);
    glEnable(GL_BLEND);
    glBlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    glBindTextureUnit(kSceneDepth, sum_.name());
    if (left_) glBindTextureUnit(kMasks, left_.name());
    compose_.draw();
    glDisable(GL_BLEND);
    if (sampled()) clear(sum_target_.name(), 0, 0);
}

}  // namespace spindrift::gl
