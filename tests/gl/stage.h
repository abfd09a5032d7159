// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "gl/context.h"
#include "gl/flake_buffers.h"
#include "gl/renderer.h"
#include "image/image.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::gl
{

/// The one headless context of the test program. Tests fail without one: Mesa's software driver is required.
Context& test_context();

/// A dark, empty, silent scene to which a test adds what it is about; the camera stands at the origin and
/// looks along +y.
struct Stage
{
    scene::Scene scene;
    scene::Geometry geometry;
    World world;
    View view;
    std::vector<Vec3f> places;
    std::vector<std::uint32_t> ids;
    bool sorted = true;

    Stage();

    /// Adds a flake; the draw list keeps the order of calls.
    void add_flake(const Vec3f& place_m, std::uint32_t id);
    /// An id whose flake has about this diameter.
    std::uint32_t id_of_diameter(double diameter_m) const;
    /// docs/drawing.md "A flake's look", in double.
    double diameter_m(std::uint32_t id) const;
    double radius_px(std::uint32_t id, double depth_m) const;

    void add_box(const Vec3f& low, const Vec3f& high, const scene::Material& material);

    image::Image draw(double time_s = 0, FlakeBuffers::Access access = FlakeBuffers::Access::mapped) const;
    /// Draws flakes that somebody else has put into these buffers.
    image::Image draw_from(const FlakeBuffers& buffers, const DrawList& list) const;
    /// Draws, and keeps the display picture in the folder for temporary files, for people to look at.
    image::Image draw_and_keep(const std::string& name, double time_s = 0) const;
};

scene::Light point_light(const Vec3d& place_m, double intensity);

/// Sum of a channel over the picture.
double total(const image::Image& image, int channel = 0);
bool all_finite(const image::Image& image);

}  // namespace spindrift::gl
