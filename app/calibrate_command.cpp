// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "app/calibration.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/find_scene.h"
#include "app/frame_drawer.h"
#include "app/progress_bar.h"
#include "core/error.h"
#include "core/light.h"
#include "core/visibility.h"
#include "cpu/cpu_backend.h"
#include "cpu/wind_projection.h"
#include "gl/context.h"
#include "image/whole_file.h"
#include "scene/make_world.h"

namespace spindrift::app
{

namespace
{

/// Room for the flakes of this long; they leave a calibration scene sooner.
constexpr double kLongestStay_s = 3;

/// The part of the picture that a black box shows, in pixels.
struct Window
{
    int left, top, right, bottom;  ///< [left, right), [top, bottom)
};

/// The side of the box that faces the camera: that of least y, as the camera of such a scene looks along +y.
Window window_of(const scene::Scene& scene, const View& view)
{
    const scene::BoxSettings& box = scene.boxes.front();
    const double focal_px = view.height_px / (2.0 * view.tan_half_fov_y);
    double low_x = 1e9, high_x = -1e9, low_y = 1e9, high_y = -1e9;
    for (const double x : {box.min_m.x, box.max_m.x})
        for (const double z : {box.min_m.z, box.max_m.z})
        {
            const Vec3d local = Vec3d{x, box.min_m.y, z} - scene.domain.min_m;
            const Vec3d d = local - Vec3d{view.eye.x, view.eye.y, view.eye.z};
            const auto along = [&](const Vec3f& axis) { return d.x * axis.x + d.y * axis.y + d.z * axis.z; };
            const double depth = along(view.forward);
            if (!(depth > view.near_m))
                throw Error(
                    "calibrate: the scene's first [[box]] is not before the camera; use a scene like sheet");
            const double px = 0.5 * view.width_px + along(view.right) / depth * focal_px;
            const double py = 0.5 * view.height_px - along(view.up) / depth * focal_px;
            low_x = std::min(low_x, px), high_x = std::max(high_x, px);
            low_y = std::min(low_y, py), high_y = std::max(high_y, py);
        }
    // a pixel of margin, so that nothing of the border counts
    const Window window{std::max(0, static_cast<int>(std::ceil(low_x)) + 1),
                        std::max(0, static_cast<int>(std::ceil(low_y)) + 1),
                        std::min(view.width_px, static_cast<int>(std::floor(high_x)) - 1),
                        std::min(view.height_px, static_cast<int>(std::floor(high_y)) - 1)};
    if (window.left >= window.right || window.top >= window.bottom)
        throw Error(
            "calibrate: the picture shows nothing of the scene's first [[box]]; use a scene like sheet");
    return window;
}

/// Mean light of the window over that of the flakes, as a grey value.
double grey_of(const image::Image& picture, const Window& window, double white)
{
    double sum = 0;
    for (int y = window.top; y < window.bottom; ++y)
        for (int x = window.left; x < window.right; ++x)
        {
            const float* c = picture.pixel(x, y);
            sum += luminance(Vec3d{c[0], c[1], c[2]});
        }
    return 255 * sum / ((window.right - window.left) * (window.bottom - window.top)) / white;
}

void require_experiment(const scene::Scene& scene)
{
    const bool steady = scene.emitters.size() == 1 && scene.emitters.front().emitter.rate_per_s > 0;
    const bool black = !scene.boxes.empty() && scene.boxes.front().albedo.r == 0 &&
                       scene.boxes.front().albedo.g == 0 && scene.boxes.front().albedo.b == 0;
    if (!steady || !black || !scene.lights.empty())
        throw Error(
            fmt::format("calibrate: {} is not the experiment (one emitter with rate_per_s, a first [[box]] "
                        "with albedo 0, no lights); use a scene like sheet",
                        scene.file.string()));
}

double measure_grey(scene::Scene scene, const scene::Geometry& geometry, const gl::Context& context,
                    const CalibrateOptions& options, double per_s)
{
    Emitter& emitter = scene.emitters.front().emitter;
    emitter.rate_per_s = per_s;
    scene.capacity = static_cast<std::uint64_t>(per_s * kLongestStay_s) + 1000;
    const World world = scene::make_world(scene, geometry, cpu::project_wind());
    StageLog log;
    auto memory = make_shared_memory(world.capacity);
    auto backend = cpu::make_cpu_backend(world, memory->flakes(), memory->draw_list(), {});
    Simulator simulator(std::move(memory), std::move(backend), log);
    FrameDrawer drawer(scene, geometry, world, simulator, context.info(), {}, log);
    const scene::Colour& ambient = scene.sky.ambient;
    const double white = luminance(Vec3d{ambient.r, ambient.g, ambient.b});
    double sum = 0;
    for (int frame = 0; frame < options.frames; ++frame)
    {
        const double time_s = scene.render.warm_up_s + frame / scene.render.frames_per_s;
        simulator.advance_to(static_cast<std::uint64_t>(std::lround(time_s / world.step_s)),
                             [] { return false; });
        const View view = scene::camera_at(scene, time_s);
        drawer.draw(view, time_s);
        sum += grey_of(drawer.renderer().read_linear(), window_of(scene, view), white);
    }
    if (simulator.backend().counts().withheld > 0)
        throw Error("calibrate: flakes stay in the scene for more than 3 s; use a scene like sheet");
    return sum / options.frames;
}

void print(const Calibration& c)
{
    fmt::print(
        "| particles/s | grey | fitted | residual | report's table | its fit, clamped | visibility of 600 m "
        "| "
        "extinction, 1/m | visibility (5 %), m |\n|---|---|---|---|---|---|---|---|---|\n");
    for (std::size_t i = 0; i < c.rows.size(); ++i)
    {
        const CalibrationRow& row = c.rows[i];
        fmt::print("| {:g} | {:.3f} | {:.3f} | {:+.3f} | {:.3f} | {:.3f} | {:.1f} | {:.4g} | {:.4g} |\n",
                   row.reading.per_s, row.reading.grey, row.fitted, row.reading.grey - row.fitted,
                   kReportTable[i].grey, row.legacy, row.visibility_m, row.per_m,
                   visibility_of_extinction(row.per_m, VisibilityContrast::five_percent));
    }
    fmt::print(
        "grey = 255 (1 - exp(-k x)), k = {:.4g} s, RMS residual {:.2f}; the report's table: k = {:.3g} s\n",
        c.cover_s, c.rms_grey, kReportCover_s);
}

}  // namespace

int calibrate(const CalibrateOptions& options)
{
    for (const auto& file : {options.csv, options.plot})
        if (!file.empty()) const image::AsideFile probe(file);
    const scene::Scene scene = scene::read_scene(find_scene(options.scene), options.overrides);
    require_experiment(scene);
    const scene::Geometry geometry = scene::read_geometry(scene);
    const std::unique_ptr<gl::Context> context = gl::make_headless_context();
    ProgressBar bar("rates", kReportTable.size());
    std::vector<GreyReading> readings;
    for (const GreyReading& report : kReportTable)
    {
        if (options.most_per_s < report.per_s) break;
        readings.push_back({report.per_s, measure_grey(scene, geometry, *context, options, report.per_s)});
        bar.show(readings.size());
    }
    const View view = scene::camera_at(scene, scene.render.warm_up_s);
    const double eye_y = static_cast<double>(view.eye.y) + scene.domain.min_m.y;
    const Calibration calibration =
        calibrate(readings, scene.boxes.front().min_m.y - std::max(scene.domain.min_m.y, eye_y));
    print(calibration);
    const auto write = [](const std::filesystem::path& file, const std::string& text)
    {
        if (!file.empty()) image::write_whole(file, std::as_bytes(std::span(text)));
    };
    write(options.csv, to_csv(calibration));
    write(options.plot, to_svg(calibration));
    return kOk;
}

}  // namespace spindrift::app
