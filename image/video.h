// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>

#include "image/write.h"

namespace spindrift::image
{

/// An H.264 MP4, encoded by an ffmpeg process that the frames are sent to (8 bit sRGB; tagged Rec.709; a row
/// or column of black makes odd sizes even). Throws Error if ffmpeg is missing or fails, with what it said.
std::unique_ptr<FrameWriter> make_video_writer(const std::filesystem::path& file, int width, int height,
                                               double frames_per_s);

}  // namespace spindrift::image
