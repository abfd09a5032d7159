// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/flake.h"
#include "core/view.h"
#include "core/world.h"
#include "image/image.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::reference
{

/// The same picture as gl::Renderer's float target, on the CPU in double precision, per pixel, flakes in
/// exact order. Slow on purpose: for scenes of some thousand flakes and pictures of some hundred pixels, as
/// the truth that drawing errors are measured against.
image::Image render(const scene::Scene& scene, const scene::Geometry& geometry, const World& world,
                    const FlakeView& flakes, std::size_t used, const View& view, double time_s);

}  // namespace spindrift::reference
