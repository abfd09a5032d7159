// SPDX-License-Identifier: MIT
#include "gl/lit_program.h"

#include <algorithm>
#include <utility>

namespace spindrift::gl
{

LitProgram::LitProgram(std::array<std::string_view, 2> files, std::vector<std::string_view> defines)
    : files_(files), defines_(std::move(defines))
{
}

ByAir::ByAir(std::array<std::string_view, 2> files, std::vector<std::string_view> defines)
{
    programs_[0] = LitProgram(files, defines);
    defines.emplace_back("AIR");
    programs_[1] = LitProgram(files, defines);
    defines.emplace_back("GLOW");
    programs_[2] = LitProgram(files, std::move(defines));
}

GLuint LitProgram::for_lights(const LitBy& lit) const
{
    LitBy variant = lit;
    variant.lights = std::min(lit.lights, kMostUnrolled + 1);
    Program& program = variants_[variant];
    if (program) return program.name();
    std::vector<std::string_view> defines = defines_;
    const std::string lights = "LIGHTS " + std::to_string(variant.lights);
    const std::string shadows = "SHADOWS " + std::to_string(variant.shadows);
    if (variant.lights <= kMostUnrolled) defines.push_back(lights);
    if (variant.shadows > 0) defines.push_back(shadows);
    if (variant.maps) defines.emplace_back("SHADOW_MAPS");
    if (variant.snow) defines.emplace_back("SNOW_SHADE");
    if (variant.glow_grids) defines.emplace_back("GLOW_GRIDS");
    program = make_program(files_, defines);
    return program.name();
}

}  // namespace spindrift::gl
