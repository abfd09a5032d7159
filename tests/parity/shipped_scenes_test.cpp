// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <unistd.h>

#include <gtest/gtest.h>

#include "cpu/wind_projection.h"
#include "scene/make_world.h"
#include "scene/scene.h"
#include "scene/write_wind.h"
#include "tests/parity/backends.h"

namespace spindrift::parity
{

namespace
{

constexpr int kSteps = 1000;
constexpr int kBetween = 100;  // steps from one comparison to the next

struct Case
{
    Variant variant;
    std::string scene;
};

std::ostream& operator<<(std::ostream& out, const Case& c)
{
    return out << c.scene << ", " << c.variant;
}

std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const auto& entry : std::filesystem::directory_iterator(SPINDRIFT_SOURCE_DIR "/scenes"))
        if (entry.path().extension() == ".toml")
            for (const Variant& variant : variants()) all.push_back({variant, entry.path().stem().string()});
    return all;
}

/// A wind for the scene that takes its wind from a file: solved for in its domain, in large cells.
std::filesystem::path write_wind_file()
{
    const std::filesystem::path scene_file =
        std::filesystem::path(testing::TempDir()) / ("wind-" + std::to_string(getpid()) + ".toml");
    std::ofstream(scene_file) << R"(
[scene]
name = "wind"
[domain]
min_m = [0, 0, 0]
max_m = [300, 180, 208]
[particles]
capacity = 1
[wind]
source = "solve"
speed_m_s = 4
cell_m = 13
[[emitter]]
shape = "point"
at_m = [1, 1, 100]
burst = 1
[[box]]
min_m = [120, 60, 0]
max_m = [160, 110, 60]
[camera]
[[camera.key]]
eye_m = [0, 0, 10]
look_at_m = [50, 50, 10]
)";
    const scene::Scene scene = scene::read_scene(scene_file);
    scene::GriddedWind wind;
    scene::make_world(scene, scene::read_geometry(scene), cpu::project_wind(), &wind);
    const std::filesystem::path file = std::filesystem::path(scene_file).replace_extension(".nc");
    scene::write_wind(file, wind, scene.domain.min_m);
    std::filesystem::remove(scene_file);
    return file;
}

class ShippedScene : public testing::TestWithParam<Case>
{
};

/// So few that an emulated device is done in seconds, unless SPINDRIFT_PARITY_PARTICLES asks for more.
std::uint64_t particles()
{
    const char* asked = std::getenv("SPINDRIFT_PARITY_PARTICLES");
    return asked != nullptr ? std::stoull(asked) : 500;
}

/// A thousand steps.
TEST_P(ShippedScene, KeepsTheOraclesHash)
{
    if (const std::string why = cannot_run_because(); !why.empty())
    {
        const char* required = std::getenv("SPINDRIFT_REQUIRE_CUDA");
        if (required != nullptr && std::string_view(required) == "1") FAIL() << why;
        GTEST_SKIP() << why;
    }
    const std::filesystem::path file = SPINDRIFT_SOURCE_DIR "/scenes/" + GetParam().scene + ".toml";
    scene::SceneOverrides overrides;
    overrides.particles = particles();
    std::filesystem::path wind_file;
    if (GetParam().scene == "two-blocks")
        overrides.winds_file = overrides.turbulence_file = wind_file = write_wind_file();
    const scene::Scene scene = scene::read_scene(file, overrides);
    const World world = scene::make_world(scene, scene::read_geometry(scene), cpu::project_wind());
    if (!wind_file.empty()) std::filesystem::remove(wind_file);
    const auto tested = GetParam().variant.make(world);
    const auto oracle = make_oracle(world);
    for (int step = 1; step <= kSteps; ++step)
    {
        tested->backend().step(), oracle->backend().step();
        if (step % kBetween == 0)
        {
            ASSERT_EQ(tested->backend().state_hash(), oracle->backend().state_hash()) << "step " << step;
        }
    }
    EXPECT_EQ(tested->backend().extent().rogue, 0U);
    EXPECT_EQ(oracle->backend().counts().emitted > 0, GetParam().scene != "empty")
        << "no flakes: nothing was compared";
}

std::string case_name(const testing::TestParamInfo<Case>& info)
{
    std::string name = info.param.scene + info.param.variant.name;
    std::erase(name, '-');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Scenes, ShippedScene, testing::ValuesIn(cases()), case_name);

}  // namespace

}  // namespace spindrift::parity
