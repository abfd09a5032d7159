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

Outputs::Outputs(const std::vector<std::string>& patterns, const scene::RenderSettings& render)
{
    std::set<std::string> seen;
    for (const std::string& pattern : patterns)
    {
        if (!seen.insert(pattern).second)
            throw Error(fmt::format("--out {}: is given twice; give each file once", pattern));
        writers_.push_back(
            image::make_frame_writer(pattern, render.width_px, render.height_px, render.frames_per_s));
    }
}

void Outputs::add(const gl::Renderer& renderer, StageLog& log)
{
    std::optional<image::Image> linear;
    std::optional<image::Image8> display;
    for (const auto& writer : writers_)
    {
        if (writer->wants_linear())
        {
            const image::Image& picture = once(linear, log, [&] { return renderer.read_linear(); });
            const StageTimer timer(log, "encode");
            writer->add(picture);
        }
        else
        {
            const image::Image8& picture = once(display, log, [&] { return renderer.read_display(); });
            const StageTimer timer(log, "encode");
            writer->add(picture);
        }
    }
}

void Outputs::finish(StageLog& log)
{
    if (writers_.empty()) return;
    const StageTimer timer(log, "finish files");
    for (const auto& writer : writers_) writer->finish();
}

}  // namespace spindrift::app
