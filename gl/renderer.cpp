// SPDX-License-Identifier: MIT
#include "gl/renderer.h"

#include <GL/glew.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/flake_motion.h"
#include "gl/active_lights.h"
#include "gl/air_pass.h"
#include "gl/bloom_pass.h"
#include "gl/cluster_lamps.h"
#include "gl/crystal_texture.h"
#include "gl/exposure_pass.h"
#include "gl/flake_look.h"
#include "gl/flake_pass.h"
#include "gl/frame_constants.h"
#include "gl/full_screen_pass.h"
#include "gl/glow_grid_pass.h"
#include "gl/lit_program.h"
#include "gl/pass_timers.h"
#include "gl/picture.h"
#include "gl/scene_pass.h"
#include "gl/shadow_pass.h"
#include "gl/tile_pass.h"
#include "gl/tone_pass.h"
#include "gl/unsorted_target.h"
#include "scene/air.h"
#include "scene/crystals.h"

namespace spindrift::gl
{

namespace
{

AirKind air_kind(const FramePlan& plan)
{
    if (plan.runs("airlight")) return AirKind::glowing;
    return plan.runs("fog") ? AirKind::thick : AirKind::clear;
}

glm::vec4 vec4(const Vec3f& v, float w)
{
    return {v.x, v.y, v.z, w};
}
glm::vec4 vec4(const scene::Colour& c, float w)
{
    return {c.r, c.g, c.b, w};
}

}  // namespace

struct Renderer::Impl
{
    scene::Scene scene;
    Snow snow;
    std::uint64_t seed;
    float extinction_per_m;  ///< of the drawn flakes
    std::vector<scene::Light> model_lights;
    const std::vector<scene::CrystalMask>& masks = scene::crystal_masks();
    Texture mask_texture;
    Picture picture;
    ScenePass scene_pass;
    ShadowPass shadow_pass;
    FullScreenPass sky, depth_tiles;
    AirPass air;
    FlakePass flakes;
    std::optional<UnsortedTarget> unsorted;  ///< made when flakes are first drawn, if they need it
    ExposurePass exposure;
    std::optional<BloomPass> bloom;  ///< made when a plan first asks for it
    TonePass tone;
    std::optional<TonePass> low_range;              ///< made when it is first asked for
    std::vector<unsigned char> read_back;           ///< RGBA, kept: fresh memory costs as much as the copy
    bool low_range_shown = false, bloomed = false;  ///< of the display picture
    TilePass tiles;
    Splatter* splatter;
    const FlakeBuffers& buffers;
    FlakeMotion motion;
    std::vector<Vec3f> velocities;
    Buffer velocity_buffer;
    std::size_t velocity_room = 0;
    Buffer frame_block;
    Buffer light_buffer;
    std::size_t light_room = 0;
    ClusteredLamps clusters;
    Buffer cluster_buffer;
    std::size_t cluster_room = 0;
    GlowGridPass glow_grids;
    GlowGridPass::Room glow_room;
    PassTimers timers;
    bool fenced;  // the host writes the flakes
    GLsync flakes_read = nullptr;

    Impl(const scene::Scene& s, const scene::Geometry& geometry, const World& w, const FlakeBuffers& drawn,
         int width, int height, Splatter* blender)
        : scene(s),
          snow(w.snow),
          seed(w.seed),
          extinction_per_m(static_cast<float>(scene::flake_extinction(s))),
          model_lights(geometry.model_lights),
          mask_texture(make_crystal_texture(masks)),
          picture(width, height),
          scene_pass(s, geometry),
          shadow_pass(s, geometry, w),
          sky("sky.vert", "sky.frag"),
          depth_tiles("full_screen.vert", "depth_tiles.frag"),
          air(s),
          flakes(s.render, static_cast<double>(w.snow.weight), drawn),
          exposure(s.render, width, height),
          tone(s),
          tiles(s, w, drawn),
          splatter(blender),
          buffers(drawn),
          motion(w),
          frame_block(make_buffer(sizeof(FrameConstants), nullptr, GL_DYNAMIC_STORAGE_BIT)),
          fenced(drawn.access() == FlakeBuffers::Access::mapped)
    {
        if (s.render.shutter_s > 0 && drawn.access() != FlakeBuffers::Access::mapped)
            throw Error(
                "render.shutter_s: the processor says how fast flakes fly, and cannot read flakes that CUDA "
                "writes; use 0, or --backend cpu");
    }
    ~Impl()
    {
        if (flakes_read != nullptr) glDeleteSync(flakes_read);
    }
    Impl(const Impl&) = delete;
    Impl& operator=(const Impl&) = delete;

    void upload_lights(const std::vector<Lamp<float>>& lamps);
    /// Makes room for grids of the lamps' glow, too, where the plan has them.
    void cluster_lights(const FramePlan& plan, const std::vector<Lamp<float>>& lamps, const View& view);
    /// How often flakes get the ambient light: once; as the report prints it, for each lamp.
    std::uint32_t flake_ambient_times(std::size_t lights) const;
    FrameConstants constants(const View& view, std::size_t lights, double time_s) const;
    void draw_shadows(const FramePlan& plan, const std::vector<Lamp<float>>& lamps, std::uint64_t slots,
                      double time_s);
    void draw_solid(const FramePlan& plan, const View& view, double time_s);
    void draw_air(const FramePlan& plan);
    void draw_flakes(const FramePlan& plan, const View& view, const DrawList& list);
    /// Of the flakes of a draw list, where streaks are drawn.
    void find_velocities(const FramePlan& plan, const DrawList& list);
    bool needs_target() const;
    void draw_unsorted(FlakeDraw what);
    void prepare_depth();
    void develop(const FramePlan& plan, double time_s);
    void show_again();
    void draw_tone(const TonePass& curve, const BloomPass* spread);
    void draw_tiles(const FramePlan& plan, const TilePass::Frame& frame);

    template <class Draw>
    void timed(const char* name, const Draw& draw)
    {
        timers.begin(name);
        draw();
        timers.end();
    }
};

void Renderer::Impl::upload_lights(const std::vector<Lamp<float>>& lamps)
{
    std::vector<PackedLight> lights;
    for (const Lamp<float>& lamp : lamps) lights.push_back(pack(lamp));
    if (lights.size() > light_room || !light_buffer)
    {
        light_room = std::max<std::size_t>(lights.size() * 2, 8);
        light_buffer = make_buffer(static_cast<GLsizeiptr>(light_room * sizeof(PackedLight)), nullptr,
                                   GL_DYNAMIC_STORAGE_BIT);
    }
    if (!lights.empty())
        glNamedBufferSubData(light_buffer.name(), 0,
                             static_cast<GLsizeiptr>(lights.size() * sizeof(PackedLight)), lights.data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kLights, light_buffer.name());
    glBindBufferBase(GL_UNIFORM_BUFFER, kFewLights, light_buffer.name());
}

void Renderer::Impl::cluster_lights(const FramePlan& plan, const std::vector<Lamp<float>>& lamps,
                                    const View& view)
{
    // A single lamp that ends somewhere is soon computed for nothing; few lights are all unrolled by GL.
    const bool many = lamps.size() > LitProgram::kMostUnrolled;
    clusters = many || count_bounded(lamps) > 1 ? ClusteredLamps(lamps, view) : ClusteredLamps();
    glow_room = {};
    if (!many) return;
    std::vector<std::uint32_t> packed = pack(clusters.view());
    const bool in_grids = plan.runs("glow grids");
    for (std::size_t i = 0; i < lamps.size(); ++i)
        packed.push_back(static_cast<std::uint32_t>(in_grids ? plan.glow_grids[i] : -1));
    const std::size_t grids = in_grids ? count_grids(plan.glow_grids) : 0;
    const std::size_t words = packed.size() + grids * GlowGrid::count();
    if (words > cluster_room)
    {
        cluster_room = words;
        cluster_buffer =
            make_buffer(static_cast<GLsizeiptr>(cluster_room * 4), nullptr, GL_DYNAMIC_STORAGE_BIT);
    }
    glNamedBufferSubData(cluster_buffer.name(), 0, static_cast<GLsizeiptr>(packed.size() * 4), packed.data());
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, kLampClusters, cluster_buffer.name());
    if (in_grids) glow_room = {cluster_buffer.name(), packed.size(), plan.glow_grids};
}

std::uint32_t Renderer::Impl::flake_ambient_times(std::size_t lights) const
{
    const bool legacy = scene.render.scattering == scene::Scattering::legacy;
    return legacy ? static_cast<std::uint32_t>(std::max<std::size_t>(lights, 1)) : 1;
}

FrameConstants Renderer::Impl::constants(const View& view, std::size_t lights, double time_s) const
{
    const auto width = static_cast<float>(view.width_px);
    const auto height = static_cast<float>(view.height_px);
    const float tan_y = view.tan_half_fov_y;
    const float guard = std::round(view.guard_px);
    const auto scale = static_cast<float>(scene.render.flake_scale);
    const std::uint32_t ambient_times = flake_ambient_times(lights);
    FrameConstants c;
    c.eye_time = vec4(view.eye, static_cast<float>(time_s));
    c.right_tan = vec4(view.right, tan_y * width / height);
    c.up_tan = vec4(view.up, tan_y);
    c.forward_near = vec4(view.forward, view.near_m);
    c.ambient_far = vec4(scene.sky.ambient, view.far_m);
    c.zenith = vec4(scene.sky.zenith, 0);
    c.horizon_focal = vec4(scene.sky.horizon, height / (2 * tan_y));
    c.look = {mean_melted_mm(snow), scale, static_cast<float>(scene.render.flake_opacity),
              snow.weight / (scale * scale)};
    c.sprite = {sprite_limits(view).largest_px, width / (width + 2 * guard), height / (height + 2 * guard),
                guard};
    c.counts = {static_cast<std::uint32_t>(lights), static_cast<std::uint32_t>(seed),
                static_cast<std::uint32_t>(masks.size()), ambient_times};
    c.picture = {width, height, extinction_per_m, 0};
    for (std::size_t i = 0; i < masks.size(); ++i)
        c.mask_means[i / 4][i % 4] = static_cast<float>(masks[i].mean);
    return c;
}

void Renderer::Impl::draw_shadows(const FramePlan& plan, const std::vector<Lamp<float>>& lamps,
                                  std::uint64_t slots, double time_s)
{
    const bool dims_lamps = plan.runs("fog") && scene.air.law == scene::FogLaw::exponential;
    if (plan.runs("shadows"))
    {
        shadow_pass.turn_to_maps(lamps);
        timed("shadows", [&] { shadow_pass.draw_scene(scene_pass, lamps, time_s); });
    }
    if (plan.runs("snow shade"))
        timed("snow shade", [&] { shadow_pass.draw_snow(buffers, slots, lamps, time_s, dims_lamps); });
    shadow_pass.bind(plan.lit);
}

void Renderer::Impl::draw_solid(const FramePlan& plan, const View& view, double time_s)
{
    glBindFramebuffer(GL_FRAMEBUFFER, picture.linear_target.name());
    glViewport(0, 0, picture.width, picture.height);
    glDisable(GL_SCISSOR_TEST);
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    constexpr GLfloat far_depth = 0;
    glClearNamedFramebufferfv(picture.linear_target.name(), GL_DEPTH, 0, &far_depth);
    if (plan.runs("scene"))
        timed("scene", [&] { scene_pass.draw(view.eye, plan.lit, time_s, air_kind(plan)); });
    glDepthMask(GL_FALSE);
    if (plan.runs("sky"))
    {
        glDepthFunc(GL_GEQUAL);
        timed("sky", [&] { sky.draw(); });
    }
    draw_air(plan);
}

void Renderer::Impl::draw_air(const FramePlan& plan)
{
    if (plan.runs("glow grids")) timed("glow grids", [&] { glow_grids.fill(glow_room); });
    if (!plan.runs("fog")) return;
    timed("fog",
          [&]
          {
              picture.copy_depth();
              air.draw_fog(picture.depth_copy.name(), plan.lit);
          });
    if (plan.runs("airlight"))
        timed("airlight", [&] { air.draw_airlight(picture.depth_copy.name(), plan.lit); });
}

void Renderer::Impl::draw_flakes(const FramePlan& plan, const View& view, const DrawList& list)
{
    const bool fades = plan.runs("fade");
    if (fades) timed("fade", [&] { prepare_depth(); });
    if (!plan.runs("flakes")) return;
    glBindTextureUnit(kMasks, mask_texture.name());
    FlakeDraw what{view,           list,      fades ? picture.depth_copy.name() : 0,          plan.lit,
                   air_kind(plan), {0, 1, 1}, velocities.empty() ? 0 : velocity_buffer.name()};
    timed("flakes", [&] { needs_target() ? draw_unsorted(what) : flakes.draw(what); });
    if (!fenced) return;
    if (flakes_read != nullptr) glDeleteSync(flakes_read);
    flakes_read = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

void Renderer::Impl::find_velocities(const FramePlan& plan, const DrawList& list)
{
    velocities.clear();
    if (scene.render.shutter_s <= 0 || !(plan.runs("flakes") || plan.runs("tiles"))) return;
    const FlakeView flakes_now = buffers.flakes();
    const DrawListView lists = buffers.draw_list();
    const std::uint64_t* pairs = list.in_scratch ? lists.scratch : lists.pairs;
    for (std::size_t i = 0; i < list.count; ++i)
        velocities.push_back(motion.velocity(flakes_now, static_cast<std::uint32_t>(pairs[i])));
    if (!plan.runs("flakes") || velocities.empty()) return;
    if (velocities.size() > velocity_room)
    {
        velocity_room = velocities.size();
        velocity_buffer = make_buffer(static_cast<GLsizeiptr>(velocity_room * sizeof(Vec3f)), nullptr,
                                      GL_DYNAMIC_STORAGE_BIT);
    }
    glNamedBufferSubData(velocity_buffer.name(), 0,
                         static_cast<GLsizeiptr>(velocities.size() * sizeof(Vec3f)), velocities.data());
}

bool Renderer::Impl::needs_target() const
{
    const scene::Blending blending = scene.render.blending;
    return blending == scene::Blending::weighted || blending == scene::Blending::stochastic;
}

void Renderer::Impl::draw_unsorted(FlakeDraw what)
{
    if (!unsorted) unsorted.emplace(scene.render, picture);
    picture.copy_depth();
    for (int pass = 0; pass < unsorted->passes(); ++pass)
    {
        what.samples = unsorted->samples(pass);
        unsorted->begin(picture);
        glBindTextureUnit(kMasks, mask_texture.name());
        flakes.draw(what);
        unsorted->end();
    }
    unsorted->compose(picture);
}

void Renderer::Impl::prepare_depth()
{
    picture.copy_depth();
    glBindFramebuffer(GL_FRAMEBUFFER, picture.tiles_target.name());
    glViewport(0, 0, (picture.width + Picture::kTilePx - 1) / Picture::kTilePx,
               (picture.height + Picture::kTilePx - 1) / Picture::kTilePx);
    glDisable(GL_DEPTH_TEST);
    glBindTextureUnit(kSceneDepth, picture.depth_copy.name());
    depth_tiles.draw();
    glBindTextureUnit(kDepthTiles, picture.depth_tiles.name());
    glBindFramebuffer(GL_FRAMEBUFFER, picture.linear_target.name());
}

void Renderer::Impl::draw_tiles(const FramePlan& plan, const TilePass::Frame& frame)
{
    if (splatter == nullptr)
        throw Error("the frame plan draws flakes in tiles, but the renderer has no splatter");
    timed("tiles",
          [&]
          {
              if (plan.runs("tone") && plan.tone_in_tiles)
                  tiles.blend_and_develop(*splatter, frame, picture);
              else
                  tiles.blend(*splatter, frame, picture);
          });
}

void Renderer::Impl::develop(const FramePlan& plan, double time_s)
{
    const GLuint linear = picture.linear.name();
    if (plan.runs("exposure")) timed("exposure", [&] { exposure.draw(linear, time_s); });
    exposure.bind();
    const bool blooms = plan.runs("bloom");
    if (blooms && !bloom) bloom.emplace(scene.bloom, picture.width, picture.height);
    if (blooms) timed("bloom", [&] { bloom->draw(linear); });
    bloomed = blooms;
    if (plan.runs("tone")) timed("tone", [&] { draw_tone(tone, blooms ? &*bloom : nullptr); });
}

void Renderer::Impl::draw_tone(const TonePass& curve, const BloomPass* spread)
{
    glBindFramebuffer(GL_FRAMEBUFFER, picture.display_target.name());
    glViewport(0, 0, picture.width, picture.height);
    curve.draw(picture.linear.name(), spread);
    low_range_shown = &curve != &tone;
}

/// The last frame holds, but may have been developed otherwise since.
void Renderer::Impl::show_again()
{
    if (!low_range_shown) return;
    exposure.bind();
    draw_tone(tone, bloomed ? &*bloom : nullptr);
}

Renderer::Renderer(const scene::Scene& scene, const scene::Geometry& geometry, const World& world,
                   const FlakeBuffers& buffers, int width_px, int height_px, Splatter* splatter)
    : impl_(std::make_unique<Impl>(scene, geometry, world, buffers, width_px, height_px, splatter))
{
}
Renderer::~Renderer() = default;

void Renderer::draw(const FramePlan& plan, const View& view, const DrawList& flakes, double time_s)
{
    Impl& m = *impl_;
    if (plan.still) return m.show_again();
    if (view.width_px != m.picture.width || view.height_px != m.picture.height)
        resize(view.width_px, view.height_px);
    m.tiles.discard();
    m.timers.begin_frame();
    const std::vector<Lamp<float>> lights = plan.runs("lights")
                                                ? active_lights(m.scene, m.model_lights, view, time_s).lamps
                                                : std::vector<Lamp<float>>{};
    m.upload_lights(lights);
    const FrameConstants constants = m.constants(view, lights.size(), time_s);
    glNamedBufferSubData(m.frame_block.name(), 0, sizeof(constants), &constants);
    glBindBufferBase(GL_UNIFORM_BUFFER, kFrameBlock, m.frame_block.name());
    glClipControl(GL_LOWER_LEFT, GL_ZERO_TO_ONE);
    m.air.prepare(plan, view, time_s);
    m.draw_shadows(plan, lights, flakes.slots, time_s);
    m.cluster_lights(plan, lights, view);  // its binding is used before
    m.draw_solid(plan, view, time_s);
    m.find_velocities(plan, flakes);
    m.draw_flakes(plan, view, flakes);
    const bool in_tiles = plan.runs("tiles");
    if (in_tiles)
    {
        const scene::Colour& ambient = m.scene.sky.ambient;
        const auto times = static_cast<float>(m.flake_ambient_times(lights.size()));
        m.draw_tiles(plan, {view, flakes, lights, m.clusters.view(), m.glow_grids.on_host(m.glow_room),
                            Vec3f{ambient.r, ambient.g, ambient.b} * times, m.air.before_flakes(),
                            m.shadow_pass.on_host(plan.lit), time_s, m.velocities.data()});
    }
    if (!in_tiles || !plan.tone_in_tiles) m.develop(plan, time_s);
}

void Renderer::wait_for_flakes() const
{
    if (impl_->flakes_read == nullptr) return;
    constexpr GLuint64 kSecond = 1'000'000'000;
    while (glClientWaitSync(impl_->flakes_read, GL_SYNC_FLUSH_COMMANDS_BIT, kSecond) == GL_TIMEOUT_EXPIRED)
    {
        // The GPU is still at it.
    }
}

void Renderer::resize(int width_px, int height_px)
{
    if (width_px == impl_->picture.width && height_px == impl_->picture.height) return;
    impl_->tiles.discard();
    impl_->picture = Picture(width_px, height_px);
    impl_->unsorted.reset();
    impl_->exposure.resize(width_px, height_px);
    impl_->bloom.reset();
}

double Renderer::exposure() const
{
    return impl_->exposure.exposure();
}

bool Renderer::found_bright() const
{
    return impl_->bloom && impl_->bloom->found_bright();
}

image::Image Renderer::read_linear() const
{
    impl_->tiles.bring_back(impl_->picture);
    const Picture& picture = impl_->picture;
    const std::size_t row = static_cast<std::size_t>(picture.width) * 4;
    const auto rows = static_cast<std::size_t>(picture.height);
    std::vector<float> pixels(row * rows);
    glGetTextureImage(picture.linear.name(), 0, GL_RGBA, GL_FLOAT, static_cast<GLsizei>(pixels.size() * 4),
                      pixels.data());
    image::Image image(picture.width, picture.height);
    for (std::size_t y = 0; y < rows; ++y)
        std::copy_n(&pixels[(rows - 1 - y) * row], row, &image.rgba[y * row]);
    return image;
}

image::Image8 Renderer::read_display() const
{
    const Picture& picture = impl_->picture;
    const auto columns = static_cast<std::size_t>(picture.width);
    const auto rows = static_cast<std::size_t>(picture.height);
    std::vector<unsigned char>& pixels = impl_->read_back;
    pixels.resize(columns * rows * 4);
    glGetTextureImage(picture.display.name(), 0, GL_RGBA, GL_UNSIGNED_BYTE,
                      static_cast<GLsizei>(pixels.size()), pixels.data());
    image::Image8 image{picture.width, picture.height, std::vector<unsigned char>(columns * rows * 3)};
    unsigned char* to = image.rgb.data();
    for (std::size_t y = rows; y-- > 0;)
        for (const unsigned char *from = &pixels[y * columns * 4], *end = from + columns * 4; from != end;
             from += 4, to += 3)
            to[0] = from[0], to[1] = from[1], to[2] = from[2];
    return image;
}

void Renderer::develop_low_range()
{
    Impl& m = *impl_;
    m.tiles.bring_back(m.picture);
    if (!m.low_range)
    {
        scene::Scene plain = m.scene;
        plain.display.tone = ToneCurve::linear;
        m.low_range.emplace(plain);
    }
    m.exposure.bind();
    m.draw_tone(*m.low_range, nullptr);
}

void Renderer::present(int framebuffer_width, int framebuffer_height)
{
    const Picture& picture = impl_->picture;
    const bool same = framebuffer_width == picture.width && framebuffer_height == picture.height;
    glBlitNamedFramebuffer(picture.display_target.name(), 0, 0, 0, picture.width, picture.height, 0, 0,
                           framebuffer_width, framebuffer_height, GL_COLOR_BUFFER_BIT,
                           same ? GL_NEAREST : GL_LINEAR);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

std::vector<PassTime> Renderer::times() const
{
    std::vector<PassTime> times;
    for (const PassTimers::Time& time : impl_->timers.times()) times.push_back({time.name, time.ms});
    return times;
}

}  // namespace spindrift::gl
