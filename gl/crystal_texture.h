// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "gl/object.h"
#include "scene/crystals.h"

namespace spindrift::gl
{

/// The grown masks as layers of one texture with their own mip levels.
Texture make_crystal_texture(std::span<const scene::CrystalMask> masks);

}  // namespace spindrift::gl
