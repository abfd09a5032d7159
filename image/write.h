// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "image/image.h"

namespace spindrift::image
{

// Every file is written aside and renamed when whole: a reader never sees half of one. All throw Error
// with the path and the system's reason (unwritable folder, a folder or device in the way, disk
// full). Missing parent folders are made.

void write_png(const std::filesystem::path& file, const Image8& image);
/// Half-float linear RGBA, ZIP compressed.
void write_exr(const std::filesystem::path& file, const Image& image);
Image8 read_png(const std::filesystem::path& file);
Image read_exr(const std::filesystem::path& file);

/// The exact sRGB encoding (IEC 61966-2-1) of linear [0, 1]; clamps, NaN becomes 0.
float srgb_encode(float linear);
Image8 to_srgb8(const Image& display_linear);

/// Two pictures of one height as one.
Image8 side_by_side(const Image8& left, const Image8& right);

/// A run's pictures, by the output pattern: "x.mp4" (H.264 by an ffmpeg process), "x_%04d.png" or ".exr"
/// (sequence; printf integer), "x.png" / "x.exr" (the last frame only).
class FrameWriter
{
  public:
    virtual ~FrameWriter() = default;
    virtual bool wants_linear() const = 0;     ///< true: give add(Image), false: give add(Image8)
    virtual bool keeps_last_only() const = 0;  ///< of all frames added only the last becomes a file
    virtual void add(const Image& linear) = 0;
    virtual void add(const Image8& display) = 0;
    /// Completes the file(s) with what was added so far, also after an interrupt.
    virtual void finish() = 0;
};
std::unique_ptr<FrameWriter> make_frame_writer(const std::string& pattern, int width, int height,
                                               double frames_per_s);

}  // namespace spindrift::image
