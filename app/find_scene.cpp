// SPDX-License-Identifier: MIT
#include "app/find_scene.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "app/build_info.h"
#include "core/error.h"

namespace spindrift::app
{

namespace fs = std::filesystem;

std::vector<fs::path> scene_folders()
{
    std::vector<fs::path> candidates = {"scenes", kSourceScenes};
    std::error_code error;
    const fs::path self = fs::read_symlink("/proc/self/exe", error);
    if (!error) candidates.push_back((self.parent_path() / kInstalledScenes).lexically_normal());

    std::vector<fs::path> folders;
    for (const fs::path& candidate : candidates)
    {
        if (!fs::is_directory(candidate, error)) continue;
        const bool known = std::any_of(folders.begin(), folders.end(),
                                       [&](const fs::path& folder)
                                       {
                                           std::error_code ignored;
                                           return fs::equivalent(folder, candidate, ignored);
                                       });
        if (!known) folders.push_back(candidate);
    }
    return folders;
}

std::vector<fs::path> shipped_scenes()
{
    std::map<std::string, fs::path> by_name;
    for (const fs::path& folder : scene_folders())
    {
        std::error_code error;
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, error))
            if (entry.path().extension() == ".toml")
                by_name.emplace(entry.path().stem().string(), entry.path());
    }
    std::vector<fs::path> scenes;
    for (const auto& [name, path] : by_name) scenes.push_back(path);
    return scenes;
}

fs::path find_scene(const std::string& path_or_name)
{
    const fs::path path(path_or_name);
    std::error_code error;
    const bool bare_name = !path.has_parent_path() && path.extension() != ".toml" && !fs::exists(path, error);
    if (!bare_name) return path;

    std::string names;
    for (const fs::path& scene : shipped_scenes())
    {
        if (scene.stem() == path) return scene;
        names += (names.empty() ? "" : ", ") + scene.stem().string();
    }
    throw Error(
        fmt::format("{}: is neither a file nor a shipped scene; give the path of a TOML file or one of: {}",
                    path_or_name, names.empty() ? "(none found)" : names));
}

}  // namespace spindrift::app
