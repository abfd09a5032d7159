// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <memory>
#include <span>

#include "core/backend.h"
#include "core/view.h"
#include "core/world.h"
#include "gl/flake_buffers.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// The floor of drawing: the same points (count, places, sizes, blending, kind of target) with a shader that
/// does nothing but pass them on. Benchmarks give the time of a whole frame as a multiple of it.
class BareDraw
{
  public:
    /// Places and sizes are worked out here, once, on the CPU.
    BareDraw(const scene::Scene& scene, const World& world, const FlakeBuffers& buffers, const View& view,
             const DrawList& flakes);
    ~BareDraw();
    BareDraw(const BareDraw&) = delete;
    BareDraw& operator=(const BareDraw&) = delete;

    /// Draws and waits until the GPU is done.
    void draw() const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace spindrift::gl
