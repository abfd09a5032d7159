// SPDX-License-Identifier: MIT
#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <string>
#include <vector>

#include "bench/drawn_row.h"
#include "core/bloom.h"
#include "core/tone.h"
#include "gl/bloom_pass.h"
#include "gl/context.h"
#include "gl/exposure_pass.h"
#include "gl/float_target.h"
#include "gl/tone_pass.h"
#include "measure/timing.h"

// Rows bloom/METHOD/SIZE: time of the bloom pass and of mixing it into the picture, and the error of the
// light as it is spread over the picture. The truth is the exact Gaussian of the same sigma in double
// precision, cut at six sigma; the light is one pixel, in the worst of several places with regard to the
// coarser texels.

namespace spindrift::bench
{

using namespace measure;

namespace
{

using scene::BloomMethod;

constexpr double kSigma_px = 128.0 / 3;  // 257 taps
constexpr float kLight = 6e4F;

struct Method
{
    const char* name;
    BloomMethod method;
};
constexpr std::array kMethods{Method{"gaussian", BloomMethod::gaussian},
                              Method{"reduced", BloomMethod::reduced},
                              Method{"pyramid", BloomMethod::pyramid}, Method{"dual", BloomMethod::dual},
                              Method{"legacy", BloomMethod::legacy}};

/// Develops a picture of one bright pixel with one method; needs a current context.
class BloomBench
{
  public:
    BloomBench(BloomMethod method, int width_px, int height_px)
        : scene_(scene_for(method, height_px)),
          width_px_(width_px),
          height_px_(height_px),
          linear_(GL_RGBA16F, width_px, height_px),
          shown_(GL_RGBA32F, width_px, height_px),
          display_(GL_RGBA8, width_px, height_px),
          exposure_(scene_.render, width_px, height_px),
          bloom_(scene_.bloom, width_px, height_px),
          tone_(scene_)
    {
        exposure_.bind();
    }

    void light_up(int x, int y)
    {
        const std::array<float, 4> black{0, 0, 0, 1}, light{kLight, kLight, kLight, 1};
        glClearNamedFramebufferfv(linear_.framebuffer.name(), GL_COLOR, 0, black.data());
        glTextureSubImage2D(linear_.texture.name(), 0, x, y, 1, 1, GL_RGBA, GL_FLOAT, light.data());
        glFinish();
    }

    double bloom_ms() const
    {
        return time_ms(
            [&]
            {
                bloom_.draw(linear_.texture.name());
                glFinish();
            });
    }
    double tone_ms(bool blooms) const
    {
        return time_ms(
            [&]
            {
                display_.bind();
                tone_.draw(linear_.texture.name(), blooms ? &bloom_ : nullptr);
                glFinish();
            });
    }

    /// Sum of the differences over the sum of the light; largest difference over the largest value.
    struct Error
    {
        double l1 = 0, peak = 0;
    };
    Error error(int x, int y)
    {
        light_up(x, y);
        bloom_.draw(linear_.texture.name());
        shown_.bind();
        tone_.draw(linear_.texture.name(), &bloom_);
        std::vector<float> drawn(static_cast<std::size_t>(width_px_) * static_cast<std::size_t>(height_px_));
        glGetTextureImage(shown_.texture.name(), 0, GL_RED, GL_FLOAT, static_cast<GLsizei>(drawn.size() * 4),
                          drawn.data());
        const auto weights = gaussian_weights(kSigma_px, static_cast<int>(6 * kSigma_px));
        const auto weight = [&](int distance)
        {
            const auto i = static_cast<std::size_t>(std::abs(distance));
            return i < weights.size() ? weights[i] : 0.0;
        };
        Error error;
        for (int row = 0; row < height_px_; ++row)
            for (int column = 0; column < width_px_; ++column)
            {
                const auto i = static_cast<std::size_t>(row) * static_cast<std::size_t>(width_px_) +
                               static_cast<std::size_t>(column);
                const double spread = kWhite * srgb_decoded(double{drawn[i]}) / double{kLight};
                const double off = std::abs(spread - weight(column - x) * weight(row - y));
                error.l1 += off;
                error.peak = std::max(error.peak, off / (weights[0] * weights[0]));
            }
        return error;
    }

  private:
    static constexpr double kWhite = 100;  // light that is shown as white

    /// All light is bright and all of it is spread, so that what is shown is the spread light.
    static scene::Scene scene_for(BloomMethod method, int height_px)
    {
        scene::Scene scene;
        scene.bloom.method = method;
        scene.bloom.weight = 1;
        scene.bloom.threshold = scene.bloom.knee = 0;
        scene.bloom.ceiling = 6e4;
        scene.bloom.sigma_px = kSigma_px * 720 / height_px;
        scene.display.dither = false;
        scene.display.tone = ToneCurve::calibrated;
        scene.display.unit_cd_m2 = 1;
        scene.display.white_cd_m2 = kWhite;
        return scene;
    }

    scene::Scene scene_;
    int width_px_, height_px_;
    gl::FloatTarget linear_, shown_, display_;
    gl::ExposurePass exposure_;
    gl::BloomPass bloom_;
    gl::TonePass tone_;
};

struct Times
{
    double bloom_ms, mix_ms;
    double whole_ms() const { return bloom_ms + mix_ms; }
};

Times times_of(BloomBench& bench, int rounds)
{
    bench.light_up(600, 300);
    std::vector<double> bloom, with, without;
    for (int round = -1; round < rounds; ++round)
    {
        const double a = bench.bloom_ms(), b = bench.tone_ms(true), c = bench.tone_ms(false);
        if (round < 0) continue;  // programs are compiled
        bloom.push_back(a);
        with.push_back(b);
        without.push_back(c);
    }
    return {quantile(bloom, 0.5), std::max(quantile(with, 0.5) - quantile(without, 0.5), 0.0)};
}

void bloom_row(benchmark::State& state, BloomMethod method, int width_px, int height_px)
{
    const auto context = gl::make_headless_context();
    BloomBench exact(BloomMethod::gaussian, width_px, height_px);
    BloomBench bench(method, width_px, height_px);
    const Times floor = times_of(exact, 3);
    const Times times = method == BloomMethod::gaussian ? floor : times_of(bench, 21);
    for (auto _ : state) state.SetIterationTime(times.whole_ms() * 1e-3);
    double l1 = 0, peak = 0;
    for (const int offset : {0, 1, 3, 5, 6})
    {
        const BloomBench::Error error = bench.error(width_px / 2 + offset, height_px / 2 + 3 * offset);
        l1 = std::max(l1, error.l1);
        peak = std::max(peak, error.peak);
    }
    state.counters["bloom_ms"] = times.bloom_ms;
    state.counters["mix_ms"] = times.mix_ms;
    state.counters["faster_than_exact"] = floor.whole_ms() / times.whole_ms();
    state.counters["error_l1"] = l1;
    state.counters["error_peak"] = peak;
    state.SetLabel(context->info().renderer);
}

bool register_rows()
{
    for (const auto& [width, height] : {std::array{1280, 720}, std::array{1920, 1080}})
        for (const Method& method : kMethods)
            add_drawn_row(std::string("bloom/") + method.name + "/" + std::to_string(width) + "x" +
                              std::to_string(height),
                          [=, width = width, height = height](benchmark::State& state)
                          { bloom_row(state, method.method, width, height); });
    return true;
}

[[maybe_unused]] const bool registered = register_rows();

}  // namespace

}  // namespace spindrift::bench
