// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace spindrift::gl
{

/// The uniform block of shaders/frame.glsl, field by field (std140: every field is a vec4 or an array of
/// them).
struct FrameConstants
{
    using Vec4 = std::array<float, 4>;
    Vec4 eye_time{};
    Vec4 right_tan{};
    Vec4 up_tan{};
    Vec4 forward_near{};
    Vec4 ambient_far{};
    Vec4 zenith_exposure{};
    Vec4 horizon_focal{};
    Vec4 look{};
    Vec4 sprite{};
    std::array<std::uint32_t, 4> counts{};
    Vec4 picture{};
    std::array<Vec4, 4> mask_means{};
};

/// Binding points that all programs share.
enum Binding : unsigned
{
    kFrameBlock = 0,
    kFewLights = 1,
    kXArray = 0,
    kYArray = 1,
    kZArray = 2,
    kIdArray = 3,
    kDrawList = 4,
    kLights = 5,
    kSceneDepth = 0,
    kMasks = 1,
    kDepthTiles = 2,
};

}  // namespace spindrift::gl
