// SPDX-License-Identifier: MIT
#include <GL/glew.h>
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <memory>
#include <random>
#include <string>
#include <vector>

#include "bench/drawn_row.h"
#include "core/shadow.h"
#include "cpu/cpu_backend.h"
#include "cpu/wind_projection.h"
#include "gl/active_lights.h"
#include "gl/context.h"
#include "gl/flake_buffers.h"
#include "gl/shadow_pass.h"
#include "measure/timing.h"
#include "reference/shadows.h"
#include "scene/make_world.h"

// Rows snow-shade/SLICES/PX: flakes of `calm` dim its low sun. Time of the pass, beside a copy of what it
// must read of the flakes; error of the share of light against the exact one, in which every flake is a disc.

namespace spindrift::bench
{

using namespace measure;

namespace
{

constexpr std::uint64_t kFlakes = 200'000;
constexpr int kSteps = 60, kRounds = 15;
constexpr std::size_t kBytesRead = 20;  // of a flake: place, id, state

/// The sun of a scene and its flakes, after some steps.
class SunlitSnow
{
  public:
    SunlitSnow(int slices, int px)
        : context_(gl::make_headless_context()),
          scene_(shaded_scene(slices, px)),
          geometry_(scene::read_geometry(scene_)),
          world_(scene::make_world(scene_, geometry_, cpu::project_wind())),
          buffers_(world_.capacity),
          backend_(cpu::make_cpu_backend(world_, buffers_.flakes(), buffers_.draw_list(), {})),
          lamps_(gl::active_lights(scene_, {}, scene::camera_at(scene_, 0), 0).lamps),
          pass_(scene_, geometry_, world_)
    {
        for (int i = 0; i < kSteps; ++i) backend_->step();
    }

    double pass_ms()
    {
        return time_ms(
            [&]
            {
                pass_.draw_snow(buffers_, backend_->slots_used(), lamps_, 0, false);
                glFinish();
            });
    }
    double copy_ms()
    {
        from_.resize(backend_->slots_used() * kBytesRead);
        to_.resize(from_.size());
        return time_ms([&] { parallel_copy(to_.data(), from_.data(), from_.size()); });
    }

    struct Error
    {
        double bias = 0;   ///< mean of slices - exact
        double patch = 0;  ///< RMS of the means over cubes of 1 m
        double place = 0;  ///< RMS at single places: where one flake's shadow falls
        double mean = 0;   ///< exact share
    };
    Error error()
    {
        const LampShadows maps = pass_.on_host({.lights = 1, .shadows = 1, .snow = true});
        const Lamp<float>& lamp = lamps_.front();
        Lamp<double> sun;
        sun.kind = LampKind::directional;
        sun.direction = {lamp.direction.x, lamp.direction.y, lamp.direction.z};
        const reference::SnowShade exact(scene_, world_, buffers_.flakes(), backend_->slots_used(), sun);
        std::mt19937 random(5);
        const auto unit = [&random] { return static_cast<double>(random() >> 8) * 0x1p-24; };
        constexpr int patches = 500, places = 200;
        Error error;
        for (int i = 0; i < patches; ++i)
        {
            const Vec3d corner{39 * unit(), 39 * unit(), 19 * unit()};
            double off = 0;
            for (int k = 0; k < places; ++k)
            {
                const Vec3d at = corner + Vec3d{unit(), unit(), unit()};
                const Vec3f narrow{static_cast<float>(at.x), static_cast<float>(at.y),
                                   static_cast<float>(at.z)};
                const double truth = exact.share_at(at);
                const double one = std::exp(-double{snow_depth(maps, 0, narrow)}) - truth;
                error.mean += truth / (patches * places);
                error.place += one * one / (patches * places);
                off += one / places;
            }
            error.bias += off / patches;
            error.patch += off * off / patches;
        }
        error.patch = std::sqrt(error.patch);
        error.place = std::sqrt(error.place);
        return error;
    }
    std::string driver() const { return context_->info().renderer; }

  private:
    static scene::Scene shaded_scene(int slices, int px)
    {
        scene::SceneOverrides overrides;
        overrides.particles = kFlakes;
        scene::Scene scene = scene::read_scene(SPINDRIFT_SOURCE_DIR "/scenes/calm.toml", overrides);
        scene.lights.front().shadow = true;
        scene.shadows.snow_slices = slices;
        scene.shadows.snow_px = px;
        return scene;
    }

    std::unique_ptr<gl::Context> context_;
    scene::Scene scene_;
    scene::Geometry geometry_;
    World world_;
    gl::FlakeBuffers buffers_;
    std::unique_ptr<Backend> backend_;
    std::vector<Lamp<float>> lamps_;
    gl::ShadowPass pass_;
    std::vector<std::byte> from_, to_;
};

void snow_shade(benchmark::State& state, int slices, int px)
{
    SunlitSnow snow(slices, px);
    std::vector<double> pass, copy;
    for (int round = -2; round < kRounds; ++round)
    {
        const double one = snow.pass_ms(), other = snow.copy_ms();
        if (round < 0) continue;  // programs are compiled
        pass.push_back(one);
        copy.push_back(other);
    }
    const SunlitSnow::Error error = snow.error();
    for (auto _ : state) state.SetIterationTime(quantile(pass, 0.5) * 1e-3);
    state.counters["x_floor"] = quantile(pass, 0.5) / quantile(copy, 0.5);
    state.counters["exact_share"] = error.mean;
    state.counters["error_bias"] = error.bias;
    state.counters["error_rms_1m"] = error.patch;
    state.counters["error_rms_place"] = error.place;
    state.SetLabel(snow.driver());
}

bool register_rows()
{
    for (const auto& [slices, px] : {std::array{1, 128}, std::array{4, 128}, std::array{8, 128},
                                     std::array{32, 128}, std::array{8, 32}, std::array{8, 256}})
        add_drawn_row("snow-shade/" + std::to_string(slices) + "/" + std::to_string(px),
                      [slices = slices, px = px](benchmark::State& state) { snow_shade(state, slices, px); });
    return true;
}

[[maybe_unused]] const bool registered = register_rows();

}  // namespace

}  // namespace spindrift::bench
