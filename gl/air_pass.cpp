// SPDX-License-Identifier: MIT
#include "gl/air_pass.h"

#include <glm/vec4.hpp>
#include <string_view>

#include "gl/frame_constants.h"

namespace spindrift::gl
{

namespace
{

constexpr std::array<std::string_view, 2> kFiles{"sky.vert", "fog.frag"};

/// The block of shaders/air.glsl.
struct AirConstants
{
    glm::vec4 layers{};
    glm::vec4 volume_low{};
    glm::vec4 volume_high{};
    glm::vec4 shade_steps{};
    std::array<glm::vec4, scene::FlakeShadeTable::kEntries / 2> shade{};
};

Vec3f narrow(const Vec3d& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

AirLayers<float> narrow(const AirLayers<double>& air)
{
    return {static_cast<float>(air.uniform_per_m), static_cast<float>(air.drift_per_m),
            static_cast<float>(air.drift_height_m), static_cast<float>(air.drift_base_m)};
}

}  // namespace

AirPass::AirPass(const scene::Scene& scene)
    : scene_(scene),
      fog_(kFiles, {"AIR"}),
      airlight_(kFiles, {"AIR", "GLOW"}),
      nothing_(make_vertex_array()),
      block_(make_buffer(sizeof(AirConstants), nullptr, GL_DYNAMIC_STORAGE_BIT))
{
}

void AirPass::prepare(const FramePlan& plan, const View& view, double time_s)
{
    thick_ = plan.runs("fog");
    glows_ = plan.runs("airlight");
    if (!thick_) return;
    if (!lens_ || !scene::same_lens(*lens_, view))
    {
        air_ = scene::air_at(scene_, view, time_s);
        area_m2_.assign(air_.shade.area_m2.begin(), air_.shade.area_m2.end());
        integral_m3_.assign(air_.shade.integral_m3.begin(), air_.shade.integral_m3.end());
        lens_ = view;
    }
    else
        scene::move_volume(air_, scene_, time_s);
    upload();
}

void AirPass::upload() const
{
    const AirLayers<float> layers = narrow(air_.layers);
    const Vec3f low = narrow(air_.low), high = narrow(air_.high);
    AirConstants c;
    c.layers = {layers.uniform_per_m, layers.drift_per_m, 1 / layers.drift_height_m, layers.drift_base_m};
    c.volume_low = {low.x, low.y, low.z, static_cast<float>(air_.flakes_per_m3)};
    c.volume_high = {high.x, high.y, high.z, air_.law == scene::FogLaw::legacy ? 1.0F : 0.0F};
    c.shade_steps = {static_cast<float>(air_.shade.first_log2),
                     static_cast<float>(air_.shade.entries_per_log2), static_cast<float>(area_m2_.size()) - 1,
                     static_cast<float>(air_.visibility_share)};
    for (std::size_t i = 0; i < area_m2_.size(); ++i)
    {
        const auto at = static_cast<int>(i % 2 * 2);
        c.shade[i / 2][at] = area_m2_[i];
        c.shade[i / 2][at + 1] = integral_m3_[i];
    }
    glNamedBufferSubData(block_.name(), 0, sizeof(c), &c);
    glBindBufferBase(GL_UNIFORM_BUFFER, kAirBlock, block_.name());
}

void AirPass::draw(const LitProgram& program, GLuint depth, const LitBy& lit) const
{
    glDisable(GL_DEPTH_TEST);
    glEnable(GL_BLEND);
    glBlendEquation(GL_FUNC_ADD);
    glBlendFuncSeparate(GL_ONE, GL_SRC_ALPHA, GL_ZERO, GL_ONE);
    glBindTextureUnit(kSceneDepth, depth);
    glUseProgram(program.for_lights(lit));
    glBindVertexArray(nothing_.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glDisable(GL_BLEND);
    glEnable(GL_DEPTH_TEST);
}

SplatAir AirPass::before_flakes() const
{
    SplatAir air;
    if (!thick_ || air_.law == scene::FogLaw::legacy) return air;
    air.thick = true;
    air.glows = glows_;
    air.layers = narrow(air_.layers);
    air.volume.low = narrow(air_.low);
    air.volume.high = narrow(air_.high);
    air.volume.flakes_per_m3 = static_cast<float>(air_.flakes_per_m3);
    air.volume.shade = {area_m2_.data(), integral_m3_.data(), static_cast<int>(area_m2_.size()),
                        static_cast<float>(air_.shade.first_log2),
                        static_cast<float>(air_.shade.entries_per_log2)};
    return air;
}

}  // namespace spindrift::gl
