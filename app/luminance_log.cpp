// SPDX-License-Identifier: MIT
#include "app/luminance_log.h"

#include <fmt/format.h>

#include "core/error.h"
#include "scene/development.h"

namespace spindrift::app
{

LuminanceLog::LuminanceLog(const scene::Scene& scene, const std::vector<std::array<int, 2>>& pixels)
    : display_(scene.display), pixels_(pixels), text_("frame,time_s,x,y,scene_cd_m2,display_cd_m2\n")
{
    if (!pixels.empty() && display_.unit_cd_m2 == 0)
        throw Error(fmt::format(
            "--luminance: {} is not calibrated (its light has no cd/m2); give display.unit_cd_m2 and "
            "display.white_cd_m2",
            scene.file.string()));
    const int width = scene.render.width_px, height = scene.render.height_px;
    for (const auto& [x, y] : pixels)
        if (x >= width || y >= height)
            throw Error(fmt::format("--pixel {},{} lies outside of the picture; use 0 to {} and 0 to {}", x,
                                    y, width - 1, height - 1));
}

void LuminanceLog::add(const gl::Renderer& renderer, std::uint64_t frame, double time_s)
{
    if (pixels_.empty()) return;
    const image::Image light = renderer.read_linear();
    const image::Image8 shown = renderer.read_display();
    for (const auto& [x, y] : pixels_)
    {
        const auto at = (static_cast<std::size_t>(y) * static_cast<std::size_t>(shown.width) +
                         static_cast<std::size_t>(x)) *
                        3;
        const scene::PixelLuminance seen =
            scene::pixel_luminance(display_, light.pixel(x, y), &shown.rgb[at]);
        text_ += fmt::format("{},{:.6f},{},{},{:.6g},{:.6g}\n", frame, time_s, x, y, seen.scene_cd_m2,
                             seen.display_cd_m2);
    }
}

}  // namespace spindrift::app
