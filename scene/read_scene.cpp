// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>

#include "core/error.h"
#include "scene/describe_scene.h"
#include "scene/scene.h"
#include "scene/toml_document.h"

namespace spindrift::scene
{
namespace
{

std::string bytes_text(double bytes)
{
    return bytes < 1e12 ? fmt::format("{:.1f} GB", bytes / 1e9) : fmt::format("{:.1f} TB", bytes / 1e12);
}

double memory_bytes()
{
    return static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
}

TomlDocument::Value toml_number(std::uint64_t value)
{
    if (value <= static_cast<std::uint64_t>(INT64_MAX)) return static_cast<std::int64_t>(value);
    return static_cast<double>(value);
}

/// Files named on a command line count from where the command runs, not from the scene's folder.
std::string from_here(const std::filesystem::path& path)
{
    std::error_code error;
    const std::filesystem::path full = std::filesystem::absolute(path, error);
    return path.empty() || error ? path.string() : full.string();
}

void set_overrides(TomlDocument& document, const SceneOverrides& overrides)
{
    const auto set = [&](std::string_view table, std::string_view key, const auto& value)
    {
        if (value) document.set(table, key, *value);
    };
    const auto set_whole = [&](std::string_view key, const std::optional<int>& value)
    {
        if (value) document.set("render", key, static_cast<std::int64_t>(*value));
    };
    const auto set_file = [&](std::string_view key, const std::optional<std::filesystem::path>& value)
    {
        if (value) document.set("wind", key, from_here(*value));
    };
    set("simulation", "reorder_every_steps", overrides.reorder_every_steps);
    set("render", "sort", overrides.sort);
    set("render", "sort_passes_per_frame", overrides.sort_passes_per_frame);
    set("render", "flake_path", overrides.flake_path);
    set("render", "blending", overrides.blending);
    set("render", "shutter_s", overrides.shutter_s);
    set("render", "frames_per_s", overrides.frames_per_s);
    set_whole("width_px", overrides.width_px);
    set_whole("height_px", overrides.height_px);
    set_whole("frames", overrides.frames);
    set_file("winds_file", overrides.winds_file);
    set_file("turbulence_file", overrides.turbulence_file);
}

/// Another number of drawn flakes for the same snow: what is emitted grows in proportion, what each stands
/// for shrinks.
void scale_snow(Scene& scene, std::uint64_t particles)
{
    const double factor = static_cast<double>(particles) / static_cast<double>(scene.capacity);
    const auto weight = static_cast<float>(static_cast<double>(scene.snow.weight) / factor);
    if (!(weight > 0) || !std::isfinite(weight))
        throw Error(
            fmt::format("command line: particles.capacity = {} is too far from the scene's {} (a flake could "
                        "not stand for "
                        "{} / {} real ones); use a number nearer to it",
                        particles, scene.capacity, scene.snow.weight, factor));
    for (EmitterSettings& settings : scene.emitters)
    {
        Emitter& emitter = settings.emitter;
        emitter.rate_per_s *= factor;
        // rounded down so that the sum still fits, but an emitter that had flakes keeps one
        const double burst = std::floor(static_cast<double>(emitter.burst) * factor);
        const bool had_any = emitter.burst > 0;
        emitter.burst = static_cast<std::uint64_t>(burst);
        if (had_any && emitter.burst == 0) emitter.burst = 1;
    }
    scene.snow.weight = weight;
    scene.capacity = particles;
}

/// Throws Error unless that many flakes have ids and fit into the memory of this machine.
void require_room(const TomlDocument& document, std::uint64_t capacity)
{
    constexpr double kMostIds = std::numeric_limits<std::uint32_t>::max();
    const double needed = kBytesPerFlake * static_cast<double>(capacity);
    const double most = std::min(kMostIds, std::floor(memory_bytes() / kBytesPerFlake));
    document.require(
        capacity >= 1 && static_cast<double>(capacity) <= most, "particles", "capacity",
        fmt::format("does not fit (at 60 B a flake that is {}, this machine has {}, and ids have 32 bits)",
                    bytes_text(needed), bytes_text(memory_bytes())),
        fmt::format("use 1 to {:.0f}", most));
}

std::string read_text(const std::filesystem::path& file)
{
    constexpr std::string_view kAllowed = "give the path of a TOML scene file";
    const auto fail = [&](std::string_view why)
    { return Error(fmt::format("{}: cannot be read ({}); {}", file.string(), why, kAllowed)); };
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (status.type() == std::filesystem::file_type::not_found) throw fail("there is no such file");
    if (error) throw fail(error.message());
    if (std::filesystem::is_directory(status)) throw fail("it is a directory");
    std::ifstream stream(file, std::ios::binary);
    if (!stream) throw fail("it does not open");
    // one byte more than a scene may have, so that parse_scene can say that it is too long
    std::string text(kMaxSceneBytes + 1, '\0');
    stream.read(text.data(), static_cast<std::streamsize>(text.size()));
    if (stream.bad()) throw fail("reading failed");
    text.resize(static_cast<std::size_t>(stream.gcount()));
    return text;
}

}  // namespace

Scene parse_scene(std::string_view text, const std::filesystem::path& name, const SceneOverrides& overrides)
{
    TomlDocument document(text, name.string());
    if (document.empty())
        throw Error(
            fmt::format("{}:1: the scene is empty (nothing says where it snows); it needs at least [domain], "
                        "[particles] and [camera]",
                        name.string()));
    set_overrides(document, overrides);
    Scene scene;
    document.read(
        [&](Section& root)
        {
            scene = {};
            describe_scene(root, scene);
        });
    scene.file = name;
    if (overrides.seed) scene.seed = *overrides.seed;
    if (overrides.particles) document.set("particles", "capacity", toml_number(*overrides.particles));
    require_room(document, overrides.particles.value_or(scene.capacity));
    if (overrides.particles) scale_snow(scene, *overrides.particles);
    return scene;
}

std::string read_about(const std::filesystem::path& file)
{
    return TomlDocument(read_text(file), file.string()).text("scene", "about");
}

Scene read_scene(const std::filesystem::path& file, const SceneOverrides& overrides)
{
    return parse_scene(read_text(file), file, overrides);
}

}  // namespace spindrift::scene
