// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "scene/nearest_name.h"
#include "scene/sort_names.h"
#include "tests/scene/small_scene.h"

namespace spindrift::scene
{
namespace
{

using testing::HasSubstr;

const std::filesystem::path kScenes = std::filesystem::path(SPINDRIFT_SOURCE_DIR) / "scenes";

std::string error_of_file(const std::filesystem::path& file)
{
    try
    {
        read_scene(file);
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return "";
}

TEST(ReadScene, FilesThatCannotBeRead)
{
    const std::filesystem::path folder = testing::TempDir();
    EXPECT_EQ(error_of_file(folder / "no.toml"),
              (folder / "no.toml").string() +
                  ": cannot be read (there is no such file); give the path of a TOML scene file");
    EXPECT_EQ(error_of_file(folder),
              folder.string() + ": cannot be read (it is a directory); give the path of a TOML scene file");
    const std::filesystem::path empty = folder / "spindrift_empty_scene.toml";
    std::ofstream(empty).close();
    EXPECT_THAT(error_of_file(empty), HasSubstr(empty.string() + ":1: the scene is empty ("));
    std::filesystem::remove(empty);
}

TEST(ReadScene, DefaultsAreThoseOfTheContract)
{
    const Scene scene = parse(kSmallScene);
    const Scene fresh;
    EXPECT_EQ(scene.file, "s.toml");
    EXPECT_EQ(scene.capacity, 1000U);
    EXPECT_EQ(scene.step_s, fresh.step_s);
    EXPECT_EQ(scene.seed, fresh.seed);
    EXPECT_EQ(scene.snow.rate_mm_h, fresh.snow.rate_mm_h);
    EXPECT_EQ(scene.wind.source, WindSource::calm);
    EXPECT_FALSE(scene.wind.turbulence) << "still air has no gusts";
    EXPECT_EQ(scene.ground.kind, GroundKind::plane);
    EXPECT_TRUE(scene.emitters.empty());
    EXPECT_EQ(scene.render.sort, "auto");
    EXPECT_EQ(scene.render.sort_passes_per_frame, 8);
    EXPECT_EQ(scene.render.width_px, 1280);
    ASSERT_EQ(scene.camera.keys.size(), 1U);
    EXPECT_EQ(scene.camera.keys[0].eye_m.y, -10);
}

TEST(ReadScene, WholeNumbersStandForRealOnesAndBack)
{
    EXPECT_EQ(parse(with("[scene]\nstep_s = 1\n")).step_s, 1.0);
    EXPECT_EQ(parse(changed("1000", "1e3")).capacity, 1000U);
    EXPECT_EQ(parse(with("[scene]\nseed = 9007199254740993\n")).seed, 9007199254740993U)
        << "not through a double";
}

TEST(ReadScene, EveryEmitterShape)
{
    const Scene scene =
        parse(with("[[emitter]]\nshape = \"point\"\nat_m = [1, 2, 3]\nrate_per_s = 0.3\n"
                   "[[emitter]]\nshape = \"line\"\nfrom_m = [1, 2, 3]\nto_m = [4, 5, 6]\nburst = 1\n"
                   "[[emitter]]\nshape = \"sphere-surface\"\ncentre_m = [5, 5, 5]\nradius_m = 5\nburst = 1\n"
                   "[[emitter]]\nshape = \"sphere-volume\"\ncentre_m = [5, 5, 5]\nradius_m = 1\nburst = 1\n"
                   "[[emitter]]\nshape = \"plane\"\ncorner_m = [1, 5, 1]\nedge_u_m = [8, 0, 0]\n"
                   "edge_v_m = [0, 0, 8]\nburst = 1\nvelocity_m_s = [0, 0, -1]\n"
                   "[[emitter]]\nshape = \"box\"\nmin_m = [0, 0, 0]\nmax_m = [10, 10, 10]\nburst = 1\n"
                   "[[emitter]]\nshape = \"sky\"\nfollows = \"camera\"\nsize_m = [30, 30, 30]\nburst = 7\n"));
    ASSERT_EQ(scene.emitters.size(), 7U);
    const auto shape = [&](std::size_t i) { return scene.emitters[i].emitter.shape; };
    for (std::size_t i = 0; i < 7; ++i) EXPECT_EQ(shape(i), static_cast<EmitterShape>(i));
    EXPECT_EQ(scene.emitters[0].emitter.rate_per_s, 0.3);
    EXPECT_TRUE(scene.emitters[0].emitter.at_rest_in_air);
    EXPECT_EQ(scene.emitters[1].b.z, 6);
    const EmitterSettings& plane = scene.emitters[4];
    EXPECT_EQ(plane.b.x, 9);
    EXPECT_EQ(plane.b.z, 1);
    EXPECT_EQ(plane.c.x, 1);
    EXPECT_EQ(plane.c.z, 9);
    EXPECT_FALSE(plane.emitter.at_rest_in_air);
    EXPECT_EQ(plane.emitter.velocity_m_s.z, -1);
    EXPECT_EQ(scene.emitters[6].follows, "camera");
    EXPECT_EQ(scene.emitters[6].b.x, 30);
    EXPECT_EQ(scene.emitters[6].emitter.burst, 7U);
}

TEST(ReadScene, WindsAndTheirDefaults)
{
    EXPECT_TRUE(parse(with("[wind]\nsource = \"log\"\nspeed_m_s = 4\n")).wind.turbulence);
    EXPECT_FALSE(parse(with("[wind]\nsource = \"uniform\"\nspeed_m_s = 4\n")).wind.turbulence);
    const Scene friction =
        parse(with("[wind]\nsource = \"log\"\nfriction_velocity_m_s = 0.084\nfrom_direction_deg = 0\n"));
    EXPECT_EQ(friction.wind.friction_velocity_m_s, 0.084);
    EXPECT_EQ(friction.wind.from_direction_deg, 0);
    const Scene file =
        parse(with("[wind]\nsource = \"file\"\nwinds_file = \"w.nc\"\nturbulence_file = \"t.nc\"\n"));
    EXPECT_TRUE(file.wind.turbulence);
    EXPECT_EQ(file.wind.winds_file, "w.nc") << "relative to the scene's folder, resolved where it is opened";
    EXPECT_FALSE(parse(with("[wind]\nsource = \"file\"\nwinds_file = \"w.nc\"\n")).wind.turbulence);
    EXPECT_TRUE(
        parse(with("[wind]\nsource = \"file\"\nwinds_file = \"w.nc\"\nturbulence = true\n")).wind.turbulence)
        << "gusts from the local shear";
}

TEST(ReadScene, LightsModelsVehicles)
{
    const Scene scene = parse(with(
        "[[vehicle]]\nname = \"plow\"\n[[vehicle.key]]\nposition_m = [1, 2, 3]\n[[vehicle.key]]\ntime_s = "
        "2\nposition_m = [4, 5, 6]\n"
        "[[model]]\nfile = \"plow.glb\"\nvehicle = \"plow\"\nup_axis = \"z\"\n"
        "[[model]]\nfile = \"town.obj\"\ncontact = \"bounce\"\nrestitution = 0.9\n"
        "[[light]]\nkind = \"spot\"\nvehicle = \"plow\"\nposition_m = [0, 0, 1]\ndirection = [0, 3, -4]\n"
        "intensity_w_sr = [1e6, 2, 3]\nflashing = true\nflash_rate_hz = 2\n"
        "[[light]]\nkind = \"directional\"\ndirection = [0, 0, -9]\nirradiance_w_m2 = [5, 6, 7]\n"));
    ASSERT_EQ(scene.vehicles.size(), 1U);
    ASSERT_EQ(scene.vehicles[0].path.keys.size(), 2U);
    EXPECT_EQ(scene.vehicles[0].path.keys[1].position_m.y, 5);
    EXPECT_FALSE(scene.models[0].solid) << "what moves is not voxelised";
    EXPECT_FALSE(scene.models[0].y_up);
    EXPECT_TRUE(scene.models[1].solid);
    EXPECT_EQ(scene.models[1].surface.contact, Contact::bounce);
    EXPECT_FLOAT_EQ(scene.models[1].surface.restitution, 0.9F);
    EXPECT_DOUBLE_EQ(scene.lights[0].direction.y, 0.6);
    EXPECT_DOUBLE_EQ(scene.lights[0].direction.z, -0.8);
    EXPECT_EQ(scene.lights[0].intensity.r, 1e6F);
    EXPECT_TRUE(std::isinf(scene.lights[0].range_m));
    EXPECT_EQ(scene.lights[1].intensity.b, 7);
    EXPECT_EQ(scene.lights[1].direction.z, -1);
}

TEST(ReadScene, OtherParticleCountsKeepTheSnow)
{
    const std::string text = with(
        "[snow]\nweight = 12\n"
        "[[emitter]]\nshape = \"point\"\nat_m = [1, 2, 3]\nrate_per_s = 40\nburst = 600\n"
        "[[emitter]]\nshape = \"point\"\nat_m = [1, 2, 3]\nburst = 1\n");
    const Scene whole = parse(text);
    for (const std::uint64_t particles : {10U, 500U, 1000U, 3000U})
    {
        SceneOverrides overrides;
        overrides.particles = particles;
        const Scene scene = parse(text, overrides);
        EXPECT_EQ(scene.capacity, particles);
        const auto weight = static_cast<double>(scene.snow.weight);
        EXPECT_NEAR(weight * scene.emitters[0].emitter.rate_per_s, 12.0 * 40, 1e-3);
        EXPECT_NEAR(weight * static_cast<double>(scene.emitters[0].emitter.burst), 12.0 * 600, weight);
        EXPECT_GE(scene.emitters[1].emitter.burst, 1U);
    }
    SceneOverrides same;
    same.particles = whole.capacity;
    EXPECT_EQ(parse(text, same).emitters[0].emitter.burst, 600U);
    EXPECT_EQ(parse(text, same).snow.weight, whole.snow.weight);
}

TEST(ReadScene, SceneForALargerMachineRunsWithFewerFlakes)
{
    SceneOverrides overrides;
    overrides.particles = 100;
    const std::string text =
        changed("1000", "1e12") + "[[emitter]]\nshape = \"point\"\nat_m = [1, 2, 3]\nburst = 500000000000\n";
    EXPECT_EQ(parse(text, overrides).emitters[0].emitter.burst, 50U);
}

TEST(ReadScene, CommandLineComesFirst)
{
    SceneOverrides overrides;
    overrides.seed = UINT64_MAX;
    overrides.sort = "qsort";
    overrides.sort_passes_per_frame = 3;
    overrides.width_px = 64;
    overrides.height_px = 32;
    overrides.frames = 2;
    overrides.frames_per_s = 12.5;
    // a wrong value in the file does not matter where the command line replaces it
    const Scene scene = parse(with("[render]\nsort = \"bogo\"\nframes = 90\n"), overrides);
    EXPECT_EQ(scene.seed, UINT64_MAX);
    EXPECT_EQ(scene.render.sort, "qsort");
    EXPECT_EQ(scene.render.sort_passes_per_frame, 3);
    EXPECT_EQ(scene.render.width_px, 64);
    EXPECT_EQ(scene.render.height_px, 32);
    EXPECT_EQ(scene.render.frames, 2);
    EXPECT_EQ(scene.render.frames_per_s, 12.5);
    EXPECT_EQ(parse(kSmallScene, overrides).render.sort, "qsort") << "also without [render]";
}

TEST(ReadScene, WindFilesOfTheCommandLineCountFromWhereItRuns)
{
    SceneOverrides overrides;
    overrides.winds_file = "w.nc";
    overrides.turbulence_file = "/data/t.nc";
    const Scene scene = parse(with("[wind]\nsource = \"file\"\n"), overrides);
    EXPECT_EQ(scene.wind.winds_file, std::filesystem::current_path() / "w.nc");
    EXPECT_EQ(scene.wind.turbulence_file, "/data/t.nc");
    EXPECT_TRUE(scene.wind.turbulence);
}

TEST(ReadScene, EverySortNameIsTaken)
{
    for (const std::string_view name : kSortNames)
    {
        SceneOverrides overrides;
        overrides.sort = name;
        EXPECT_EQ(parse(kSmallScene, overrides).render.sort, name);
    }
}

TEST(ReadScene, EveryReadySceneIsWhole)
{
    int scenes = 0;
    for (const auto& entry : std::filesystem::directory_iterator(kScenes))
    {
        if (entry.path().extension() != ".toml") continue;
        ++scenes;
        SceneOverrides overrides;
        if (entry.path().stem() == "two-blocks")
        {
            EXPECT_THAT(error_of_file(entry.path()), HasSubstr("wind.winds_file is missing ("));
            overrides.winds_file = "w.nc";
        }
        const Scene scene = read_scene(entry.path(), overrides);
        EXPECT_EQ(read_about(entry.path()), scene.about);
        EXPECT_FALSE(scene.about.empty()) << entry.path();
        for (const ModelSettings& model : scene.models)
            EXPECT_TRUE(std::filesystem::exists(kScenes / model.file)) << model.file;
        const bool field = scene.ground.kind == GroundKind::height_field;
        EXPECT_TRUE(!field || std::filesystem::exists(kScenes / scene.ground.file)) << scene.ground.file;
    }
    EXPECT_GE(scenes, 6);
}

TEST(ReadScene, CanyonIsTheTestOfTheAncestors)
{
    const Scene scene = read_scene(kScenes / "canyon.toml");
    const Vec3d size = scene.domain.max_m - scene.domain.min_m;
    EXPECT_EQ(size.x, 20);
    EXPECT_EQ(size.y, 80);
    EXPECT_EQ(size.z, 10);
    EXPECT_EQ(scene.capacity, 250000U);
    EXPECT_EQ(scene.voxel_m, 1);
    EXPECT_EQ(scene.wind.cell_m, 1);
    EXPECT_EQ(scene.wind.friction_velocity_m_s, 0.084);
    const EmitterSettings& source = scene.emitters.at(0);
    EXPECT_EQ(source.emitter.shape, EmitterShape::plane);
    EXPECT_EQ(source.a.y, 75);
    EXPECT_EQ(source.b.x - source.a.x, 18);
    EXPECT_EQ(source.c.z - source.a.z, 8);
}

TEST(ReadScene, TownHasAMillionFlakesAndASodiumLamp)
{
    const Scene scene = read_scene(kScenes / "town.toml");
    EXPECT_EQ(scene.emitters.at(0).emitter.burst, 1000000U);
    ASSERT_EQ(scene.lights.size(), 1U);
    EXPECT_GT(scene.lights[0].intensity.r, 1.5F * scene.lights[0].intensity.g);
    EXPECT_TRUE(scene.wind.around_solids);
    EXPECT_TRUE(scene.wind.turbulence);
}

TEST(NearestName, CountsEdits)
{
    const std::vector<std::string_view> known{"speed_m_s", "source", "cell_m"};
    EXPECT_EQ(nearest_name("sped_m_s", known), "speed_m_s");
    EXPECT_EQ(nearest_name("soruce", known), "source") << "a swap is one edit";
    EXPECT_EQ(nearest_name("cel_m", known), "cell_m");
    EXPECT_EQ(nearest_name("gravity", known), "");
    EXPECT_EQ(nearest_name("", known), "");
    EXPECT_EQ(nearest_name(std::string(100000, 'x'), known), "");
    EXPECT_EQ(nearest_name("x", {}), "");
}

}  // namespace
}  // namespace spindrift::scene
