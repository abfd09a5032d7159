// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "gl/program.h"

namespace spindrift::gl
{

/// A program that loops over the active lights, in one variant per small number of them: software GL reads a
/// light whose index is known when it compiles an order faster. Variants are made when they are first asked
/// for.
class LitProgram
{
  public:
    LitProgram() = default;
    LitProgram(std::array<std::string_view, 2> files, std::vector<std::string_view> defines = {});

    GLuint for_lights(std::size_t count) const;

  private:
    static constexpr std::size_t kMostUnrolled = 8;
    std::array<std::string_view, 2> files_;
    std::vector<std::string_view> defines_;
    mutable std::array<Program, kMostUnrolled + 2> variants_;  // the last one takes any number
};

}  // namespace spindrift::gl
