// SPDX-License-Identifier: MIT
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

#include "core/error.h"
#include "scene/scene.h"

namespace spindrift::scene
{

/// The least that a scene needs, eight lines.
inline constexpr std::string_view kSmallScene =
    "[domain]\n"
    "min_m = [0, 0, 0]\n"
    "max_m = [10, 10, 10]\n"
    "[particles]\n"
    "capacity = 1000\n"
    "[[camera.key]]\n"
    "eye_m = [0, -10, 2]\n"
    "look_at_m = [5, 5, 2]\n";

/// kSmallScene and, from line 9 on, more.
inline std::string with(std::string_view more)
{
    return std::string(kSmallScene) + std::string(more);
}

/// kSmallScene with a part of it changed.
inline std::string changed(std::string_view from, std::string_view to)
{
    std::string text(kSmallScene);
    const std::size_t place = text.find(from);
    if (place == std::string::npos) throw std::logic_error("not in the small scene");
    return text.replace(place, from.size(), to);
}

inline Scene parse(std::string_view text, const SceneOverrides& overrides = {})
{
    return parse_scene(text, "s.toml", overrides);
}

/// What a text is answered with; "" if it is accepted.
inline std::string error_of(std::string_view text, const SceneOverrides& overrides = {})
{
    try
    {
        parse(text, overrides);
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "";
}

}  // namespace spindrift::scene
