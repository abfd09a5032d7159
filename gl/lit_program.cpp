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

GLuint LitProgram::for_lights(std::size_t count) const
{
    const std::size_t variant = std::min(count, kMostUnrolled + 1);
    if (!variants_[variant])
    {
        std::vector<std::string_view> defines = defines_;
        const std::string number = "LIGHTS " + std::to_string(variant);
        if (variant <= kMostUnrolled) defines.push_back(number);
        variants_[variant] = make_program(files_, defines);
    }
    return variants_[variant].name();
}

}  // namespace spindrift::gl
