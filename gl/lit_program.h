// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <compare>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "gl/program.h"

namespace spindrift::gl
{

/// By what a frame is lit.
struct LitBy
{
    std::size_t lights = 0;
    std::size_t shadows = 0;  ///< the first so many lights cast them
    bool maps = false;        ///< of the scene
    bool snow = false;        ///< flakes dim the light
    bool glow_grids = false;  ///< some lamps' glow is looked up (core/glow_grid.h)
    auto operator<=>(const LitBy&) const = default;
};

/// A program that loops over the active lights, in one variant per small number of them: software GL reads a
/// light whose index is known when it compiles an order faster. Variants are made when they are first asked
/// for.
class LitProgram
{
  public:
    LitProgram() = default;
    LitProgram(std::array<std::string_view, 2> files, std::vector<std::string_view> defines = {});

    GLuint for_lights(const LitBy& lit) const;

    /// More lights than this are read from a buffer, each where it counts (LampClusters).
    static constexpr std::size_t kMostUnrolled = 8;

  private:
    std::array<std::string_view, 2> files_;
    std::vector<std::string_view> defines_;
    mutable std::map<LitBy, Program> variants_;  // one takes any number of lights above the unrolled ones
};

/// Whether snow between things dims light.
enum class AirKind : std::size_t
{
    clear,
    thick,
    glowing,  ///< thick, and lamps light it
};

/// A lit program for each kind of air; the shaders know AIR and GLOW.
class ByAir
{
  public:
    ByAir() = default;
    ByAir(std::array<std::string_view, 2> files, std::vector<std::string_view> defines = {});
    const LitProgram& in(AirKind air) const { return programs_[static_cast<std::size_t>(air)]; }

  private:
    std::array<LitProgram, 3> programs_;
};

}  // namespace spindrift::gl
