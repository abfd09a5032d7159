// SPDX-License-Identifier: MIT
#pragma once

#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "core/light.h"
#include "core/view.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// One light as shaders/lights.glsl reads it (std430).
struct PackedLight
{
    glm::vec4 place{};
    glm::vec4 direction{};
    glm::vec4 intensity{};
    glm::vec4 limits{};
};

PackedLight pack(const Lamp<float>& lamp);

/// The lights that count in a frame, and why the others do not.
struct ActiveLights
{
    std::vector<Lamp<float>> lamps;  ///< those that cast shadows first
    int absent = 0;                  ///< do not exist, are off or have no intensity
    int dark_now = 0;                ///< flash, and are in the dark part of their period
    int out_of_range = 0;            ///< their range does not touch what the camera sees
};

/// Lights of the scene and of its models at the display time, in the local frame. Pure. Leaving a light out
/// changes no pixel. Lamps without a range get that of RenderSettings::dimmest_lamp_w_m2.
ActiveLights active_lights(const scene::Scene& scene, std::span<const scene::Light> model_lights,
                           const View& view, double time_s);

}  // namespace spindrift::gl
