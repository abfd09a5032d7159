// SPDX-License-Identifier: MIT
#include "scene/section.h"

#include <fmt/format.h>

namespace spindrift::scene
{

std::string allowed_numbers(const Range& range)
{
    if (!range.allowed.empty()) return std::string(range.allowed);
    return fmt::format("{}{}{} to {}", range.above_min ? "above " : "", range.min, range.above_min ? "," : "",
                       range.max);
}

}  // namespace spindrift::scene
