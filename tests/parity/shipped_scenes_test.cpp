// SPDX-License-Identifier: MIT
#include <cstdlib>
#include <filesystem>
#include <string_view>

#include <gtest/gtest.h>

#include "cpu/wind_projection.h"
#include "scene/make_world.h"
#include "scene/scene.h"
#include "tests/parity/backends.h"

namespace spindrift::parity
{

namespace
{

constexpr int kSteps = 1000;

struct Case
{
    Variant variant;
    std::string scene;
};

/// All that lie in scenes/ and bring their wind with them.
std::vector<Case> cases()
{
    std::vector<Case> all;
    for (const auto& entry : std::filesystem::directory_iterator(SPINDRIFT_SOURCE_DIR "/scenes"))
        if (entry.path().extension() == ".toml" && entry.path().stem() != "two-blocks")
            for (const Variant& variant : variants()) all.push_back({variant, entry.path().stem().string()});
    return all;
}

class ShippedScene : public testing::TestWithParam<Case>
{
};

/// A thousand steps with few flakes, so that an emulated device is done in seconds.
TEST_P(ShippedScene, EndsWithTheOraclesHash)
{
    if (const std::string why = cannot_run_because(); !why.empty())
    {
        const char* required = std::getenv("SPINDRIFT_REQUIRE_CUDA");
        if (required != nullptr && std::string_view(required) == "1") FAIL() << why;
        GTEST_SKIP() << why;
    }
    const std::filesystem::path file = SPINDRIFT_SOURCE_DIR "/scenes/" + GetParam().scene + ".toml";
    scene::SceneOverrides overrides;
    if (scene::read_scene(file).capacity > 500) overrides.particles = 500;
    const scene::Scene scene = scene::read_scene(file, overrides);
    const World world = scene::make_world(scene, scene::read_geometry(scene), cpu::project_wind());
    const auto tested = GetParam().variant.make(world);
    const auto oracle = make_oracle(world);
    for (int i = 0; i < kSteps; ++i) tested->backend().step(), oracle->backend().step();
    EXPECT_EQ(tested->backend().state_hash(), oracle->backend().state_hash());
    EXPECT_EQ(tested->backend().extent().rogue, 0U);
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
