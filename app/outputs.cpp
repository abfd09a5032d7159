// SPDX-License-Identifier: MIT
#include "app/outputs.h"

#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/error.h"

namespace spindrift::app
{

namespace
{

/// Reads a form of the picture the first time that somebody wants it.
template <class Picture, class Read>
const Picture& once(std::optional<Picture>& kept, StageLog& log, const Read& read)
{
    if (!kept)
    {
        const StageTimer timer(log, "read-back");
        kept = read();
    }
    return *kept;
}

}  // namespace

Outputs::Outputs(const std::vector<std::string>& patterns, const scene::RenderSettings& render, Beside beside)
    : beside_(beside)
{
    const int width_px = beside == Beside::nothing ? render.width_px : 2 * render.width_px;
    std::set<std::string> seen;
    for (const std::string& pattern : patterns)
    {
        if (!seen.insert(pattern).second)
            throw Error(fmt::format("--out {}: is given twice; give each file once", pattern));
        writers_.push_back(
            image::make_frame_writer(pattern, width_px, render.height_px, render.frames_per_s));
        if (beside != Beside::nothing && writers_.back()->wants_linear())
            throw Error(fmt::format(
                "--out {}: --beside-ldr compares what is shown, not light; use .png or .mp4", pattern));
    }
}

image::Image8 Outputs::display_of(gl::Renderer& renderer) const
{
    image::Image8 picture = renderer.read_display();
    if (beside_ == Beside::nothing) return picture;
    renderer.develop_low_range();
    return image::side_by_side(renderer.read_display(), picture);
}

void Outputs::give(gl::Renderer& renderer, StageLog& log, bool last_only)
{
    std::optional<image::Image> linear;
    std::optional<image::Image8> display;
    for (const auto& writer : writers_)
    {
        if (writer->keeps_last_only() != last_only) continue;
        if (writer->wants_linear())
        {
            const image::Image& picture = once(linear, log, [&] { return renderer.read_linear(); });
            const StageTimer timer(log, "encode");
            writer->add(picture);
        }
        else
        {
            const image::Image8& picture = once(display, log, [&] { return display_of(renderer); });
            const StageTimer timer(log, "encode");
            writer->add(picture);
        }
    }
}

void Outputs::add(gl::Renderer& renderer, StageLog& log)
{
    give(renderer, log, false);
    drawn_ = true;
}

void Outputs::finish(gl::Renderer& renderer, StageLog& log)
{
    if (writers_.empty()) return;
    if (drawn_) give(renderer, log, true);
    const StageTimer timer(log, "finish files");
    for (const auto& writer : writers_) writer->finish();
}

}  // namespace spindrift::app
