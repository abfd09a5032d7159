// SPDX-License-Identifier: MIT
#include "gl/shadow_pass.h"

#include <algorithm>
#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <string_view>

#include "core/snow.h"
#include "gl/frame_constants.h"
#include "scene/air.h"
#include "scene/flake_shade.h"

namespace spindrift::gl
{

namespace
{

constexpr GLint kLens = 1;                                    // of shadow_map.vert
constexpr GLint kSlots = 0, kSize = 2, kLook = 3, kSeed = 4;  // of snow_deposit.comp
constexpr GLuint kStateArray = 6, kCells = 7;                 // bound where they are used
constexpr std::size_t kIds = 9, kStates = 10;                 // arrays of FlakeView

/// The block of shaders/shadow.glsl.
struct ShadowConstants
{
    std::array<glm::mat4, kMostShadows> map;
    std::array<glm::mat4, kMostShadows> snow;
    glm::vec4 texel{}, counts{}, layers{};
};

glm::vec4 vec4(const float (&row)[4])
{
    return {row[0], row[1], row[2], row[3]};
}

/// For vector * matrix: the rows of the lens are its columns.
glm::mat4 matrix(const LampLens& lens)
{
    return {vec4(lens.across), vec4(lens.up), vec4(lens.depth), vec4(lens.width)};
}

std::size_t casters(const std::vector<Lamp<float>>& lamps)
{
    return static_cast<std::size_t>(
        std::count_if(lamps.begin(), lamps.end(), [](const Lamp<float>& lamp) { return lamp.casts_shadow; }));
}

std::size_t texels(int px)
{
    return static_cast<std::size_t>(px) * static_cast<std::size_t>(px);
}

/// Linear between texels; `compare`: of the answers whether a depth is not beyond the texel's.
Sampler make_map_sampler(bool compare)
{
    Sampler sampler = make_linear_sampler(GL_CLAMP_TO_EDGE);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_WRAP_R, GL_CLAMP_TO_EDGE);
    if (!compare) return sampler;
    glSamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
    glSamplerParameteri(sampler.name(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    return sampler;
}

Texture make_layers(GLenum target, GLenum format, int px, std::size_t layers)
{
    GLuint name = 0;
    glCreateTextures(target, 1, &name);
    Texture texture(name);
    glTextureStorage3D(name, 1, format, px, px, static_cast<GLsizei>(layers));
    return texture;
}

CasterBox narrow(const scene::FlakeBox& box)
{
    const auto corner = [](const Vec3d& v) {
        return Vec3f{static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
    };
    return {corner(box.low), corner(box.high)};
}

}  // namespace

ShadowPass::ShadowPass(const scene::Scene& scene, const scene::Geometry& geometry, const World& world)
    : scene_(scene),
      casters_(casters_of(scene, geometry)),
      mean_melted_mm_(static_cast<float>(
          1 / size_law(world.snow.spectrum, static_cast<double>(world.snow.rate_mm_h)).slope)),
      seed_(world.seed),
      cover_(scene::flake_cover(scene.render, world.snow)),
      block_(make_buffer(sizeof(ShadowConstants), nullptr, GL_DYNAMIC_STORAGE_BIT)),
      compare_(make_map_sampler(true)),
      linear_(make_map_sampler(false))
{
}

void ShadowPass::make_maps(std::size_t lamps)
{
    if (lamps <= map_room_) return;
    map_room_ = lamps;
    known_.map_px = scene_.shadows.map_px;
    maps_ = make_layers(GL_TEXTURE_2D_ARRAY, GL_DEPTH_COMPONENT32F, known_.map_px, lamps);
    if (depth_program_.name() == 0)
        depth_program_ = make_program(std::array<std::string_view, 1>{"shadow_map.vert"});
    targets_.clear();
    for (std::size_t i = 0; i < lamps; ++i)
    {
        targets_.push_back(make_framebuffer());
        glNamedFramebufferTextureLayer(targets_.back().name(), GL_DEPTH_ATTACHMENT, maps_.name(), 0,
                                       static_cast<GLint>(i));
        require_complete(targets_.back(), "shadow map");
    }
}

void ShadowPass::turn_to_maps(const std::vector<Lamp<float>>& lamps)
{
    make_maps(casters(lamps));
    glBindFramebuffer(GL_FRAMEBUFFER, targets_.front().name());
    glViewport(0, 0, known_.map_px, known_.map_px);
    glDisable(GL_SCISSOR_TEST);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
}

void ShadowPass::draw_scene(const ScenePass& solids, const std::vector<Lamp<float>>& lamps, double time_s)
{
    const std::size_t count = casters(lamps);
    glEnable(GL_DEPTH_TEST);
    glDepthFunc(GL_LESS);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_CLAMP);  // what stands nearer to the light than the map begins hides too
    const GLuint program = depth_program_.name();
    glUseProgram(program);
    for (std::size_t i = 0; i < count; ++i)
    {
        // A spot's map begins before the lamp's own housing.
        if (lamps[i].kind == LampKind::spot) glDisable(GL_DEPTH_CLAMP);
        known_.map[i] = map_lens(lamps[i], casters_, known_.map_px);
        const glm::mat4 lens = matrix(known_.map[i]);
        glProgramUniformMatrix4fv(program, kLens, 1, GL_FALSE, &lens[0][0]);
        glBindFramebuffer(GL_FRAMEBUFFER, targets_[i].name());
        constexpr GLfloat farthest = 1;
        glClearNamedFramebufferfv(targets_[i].name(), GL_DEPTH, 0, &farthest);
        solids.draw_casters(program, time_s);
        glEnable(GL_DEPTH_CLAMP);
    }
    glDisable(GL_DEPTH_CLAMP);
    maps_fetched_ = uploaded_ = false;
}

void ShadowPass::make_slices(std::size_t lamps)
{
    if (lamps <= snow_room_) return;
    snow_room_ = lamps;
    known_.snow_px = scene_.shadows.snow_px;
    known_.snow_slices = scene_.shadows.snow_slices;
    const auto slices = static_cast<std::size_t>(known_.snow_slices);
    snow_ = make_layers(GL_TEXTURE_3D, GL_R32F, known_.snow_px, lamps * (slices + 1));
    const auto bytes = static_cast<GLsizeiptr>(texels(known_.snow_px) * slices * lamps * 4);
    cells_ = make_buffer(bytes, nullptr, 0);
    glClearNamedBufferData(cells_.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
    if (deposit_.name() != 0) return;
    deposit_ = make_program(std::array<std::string_view, 1>{"snow_deposit.comp"});
    sum_ = make_program(std::array<std::string_view, 1>{"snow_sum.comp"});
}

void ShadowPass::deposit(const FlakeBuffers& flakes, std::uint64_t slots, std::size_t lamp) const
{
    const GLuint program = deposit_.name(), state = flakes.state_buffer();
    const auto bytes = static_cast<GLsizeiptr>(flakes.array_stride() * 4);
    const auto bind = [&](GLuint binding, std::size_t array) {
        glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, state, static_cast<GLintptr>(array) * bytes,
                          bytes);
    };
    bind(kXArray, 0);
    bind(kYArray, 1);
    bind(kZArray, 2);
    bind(kIdArray, kIds);
    bind(kStateArray, kStates);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kCells, cells_.name());
    const glm::mat4 lens = matrix(known_.snow_map[lamp]);
    const auto slices = static_cast<GLuint>(known_.snow_slices);
    glProgramUniform1ui(program, kSlots, static_cast<GLuint>(slots));
    glProgramUniformMatrix4fv(program, kLens, 1, GL_FALSE, &lens[0][0]);
    glProgramUniform3ui(program, kSize, static_cast<GLuint>(known_.snow_px), slices,
                        static_cast<GLuint>(lamp) * slices);
    glProgramUniform4f(program, kLook, mean_melted_mm_, 0.5F * static_cast<float>(scene_.render.flake_scale),
                       static_cast<float>(cover_), known_.snow_map[lamp].texel_m);
    glProgramUniform1ui(program, kSeed, static_cast<GLuint>(seed_));
    glUseProgram(program);
    constexpr std::uint64_t kGroup = 64;
    glDispatchCompute(static_cast<GLuint>((slots + kGroup - 1) / kGroup), 1, 1);
}

void ShadowPass::draw_snow(const FlakeBuffers& flakes, std::uint64_t slots,
                           const std::vector<Lamp<float>>& lamps, double time_s, bool in_fog)
{
    const std::size_t count = casters(lamps);
    make_slices(count);
    const CasterBox box = narrow(scene::flake_box(scene_, time_s));
    for (std::size_t i = 0; i < count; ++i)
    {
        known_.snow_map[i] = snow_lens(lamps[i], box, known_.snow_px);
        known_.snow_counts[i] = in_fog && lamps[i].kind == LampKind::spot ? 0.0F : 1.0F;
        if (slots > 0) deposit(flakes, slots, i);
    }
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
    glUseProgram(sum_.name());
    glProgramUniform2ui(sum_.name(), 0, static_cast<GLuint>(known_.snow_px),
                        static_cast<GLuint>(known_.snow_slices));
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kCells, cells_.name());
    glBindImageTexture(0, snow_.name(), 0, GL_TRUE, 0, GL_WRITE_ONLY, GL_R32F);
    const auto groups = static_cast<GLuint>((known_.snow_px + 7) / 8);
    glDispatchCompute(groups, groups, static_cast<GLuint>(count));
    glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_TEXTURE_UPDATE_BARRIER_BIT |
                    GL_SHADER_STORAGE_BARRIER_BIT);
    snow_fetched_ = uploaded_ = false;
}

void ShadowPass::upload()
{
    if (uploaded_) return;
    ShadowConstants c;
    for (std::size_t i = 0; i < kMostShadows; ++i)
    {
        c.map[i] = matrix(known_.map[i]);
        c.snow[i] = matrix(known_.snow_map[i]);
        c.texel[static_cast<int>(i)] = known_.map[i].texel_m;
        c.counts[static_cast<int>(i)] = known_.snow_counts[i];
    }
    const auto slices = static_cast<float>(known_.snow_slices);
    c.layers = {slices, 1 / (std::max(static_cast<float>(snow_room_), 1.0F) * (slices + 1)), 0, 0};
    glNamedBufferSubData(block_.name(), 0, sizeof(c), &c);
    uploaded_ = true;
}

void ShadowPass::bind(const LitBy& lit)
{
    if (lit.shadows == 0) return;
    upload();
    glBindBufferBase(GL_UNIFORM_BUFFER, kShadowBlock, block_.name());
    if (lit.maps) glBindTextureUnit(kShadowMaps, maps_.name());
    if (lit.maps) glBindSampler(kShadowMaps, compare_.name());
    if (lit.snow) glBindTextureUnit(kSnowDepths, snow_.name());
    if (lit.snow) glBindSampler(kSnowDepths, linear_.name());
}

LampShadows ShadowPass::on_host(const LitBy& lit)
{
    LampShadows shadows = known_;
    shadows.lamps = lit.shadows;
    if (!lit.maps) shadows.map_px = 0;
    if (!lit.snow) shadows.snow_slices = 0;
    if (lit.maps && !maps_fetched_)
    {
        host_maps_.resize(texels(known_.map_px) * map_room_);
        glGetTextureImage(maps_.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT,
                          static_cast<GLsizei>(host_maps_.size() * 4), host_maps_.data());
        maps_fetched_ = true;
    }
    if (lit.snow && !snow_fetched_)
    {
        host_snow_.resize(texels(known_.snow_px) * snow_room_ *
                          (static_cast<std::size_t>(known_.snow_slices) + 1));
        glGetTextureImage(snow_.name(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(host_snow_.size() * 4),
                          host_snow_.data());
        snow_fetched_ = true;
    }
    shadows.nearest = host_maps_.data();
    shadows.snow = host_snow_.data();
    return shadows;
}

}  // namespace spindrift::gl
