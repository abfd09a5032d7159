// SPDX-License-Identifier: MIT
#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/find_scene.h"
#include "core/error.h"
#include "scene/scene.h"

namespace spindrift::app
{

namespace
{

/// What a scene says of itself that is whole but for the wind file, which the command line must name.
std::optional<std::string> about_without_wind(const std::filesystem::path& file)
{
    scene::SceneOverrides overrides;
    overrides.winds_file = file;  // any file that exists: it is not read
    try
    {
        return scene::read_scene(file, overrides).about;
    }
    catch (const Error&)
    {
        return std::nullopt;
    }
}

/// What a scene says of itself, or what is wrong with it.
std::string about(const std::filesystem::path& file)
{
    try
    {
        return scene::read_scene(file).about;
    }
    catch (const Error& e)
    {
        if (const auto windless = about_without_wind(file)) return *windless + " Needs --wind FILE.";
        return fmt::format("(cannot be run: {})", e.what());
    }
}

}  // namespace

int list_scenes()
{
    const auto scenes = shipped_scenes();
    if (scenes.empty())
        throw Error(
            "no shipped scenes were found; run from the source folder, or give `spindrift run` a path");
    std::size_t width = 0;
    for (const auto& file : scenes) width = std::max(width, file.stem().string().size());
    for (const auto& file : scenes)
        fmt::print("{:{}}  {}\n{:{}}  {}\n", file.stem().string(), width, about(file), "", width,
                   file.string());
    return kOk;
}

}  // namespace spindrift::app
