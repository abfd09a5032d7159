// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <glm/vec4.hpp>

namespace spindrift::gl
{

/// The uniform block of shaders/frame.glsl, field by field (std140: every field is a vec4 or an array of
/// them).
struct FrameConstants
{
    glm::vec4 eye_time{};
    glm::vec4 right_tan{};
    glm::vec4 up_tan{};
    glm::vec4 forward_near{};
    glm::vec4 ambient_far{};
    glm::vec4 zenith{};
    glm::vec4 horizon_focal{};
    glm::vec4 look{};
    glm::vec4 sprite{};
    glm::uvec4 counts{};
    glm::vec4 picture{};
    std::array<glm::vec4, 4> mask_means{};
};

/// Binding points that all programs share.
enum Binding : unsigned
{
    kFrameBlock = 0,
    kFewLights = 1,
    kExposure = 2,
    kBloomCommand = 3,
    kAirBlock = 4,
    kShadowBlock = 5,
    kXArray = 0,
    kYArray = 1,
    kZArray = 2,
    kIdArray = 3,
    kDrawList = 4,
    kLights = 5,
    kBloomCommandWritten = 6,
    kExposureWritten = 7,
    kFlakeVelocities = 6,
    kDrawCommands = 6,  // each of these is bound where it is used
    kLampClusters = 7,  // until something is exposed
    kSceneDepth = 0,
    kMasks = 1,
    kDepthTiles = 2,
    kShadowMaps = 3,
    kSnowDepths = 4,
};

}  // namespace spindrift::gl
