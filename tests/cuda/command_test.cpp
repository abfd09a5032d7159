// SPDX-License-Identifier: MIT
// The command on a CUDA device, from outside: the picture and the hash are the processor's, whichever way the
// flakes come to OpenGL.
#include <gmock/gmock.h>

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/error.h"
#include "image/write.h"
#include "spindrift/simulation.h"
#include "tests/app/child_process.h"
#include "tests/app/command_fixture.h"
#include "tests/app/solved_house.h"
#include "tests/cuda/device_fixture.h"

namespace spindrift::test
{

namespace
{

using nlohmann::json;
using testing::AllOf;
using testing::HasSubstr;

class CudaCommand : public Command
{
  protected:
    void SetUp() override { gpu::require_device(); }

    struct Drawn
    {
        std::vector<unsigned char> rgb;
        json stats;
    };

    Drawn draw(const std::string& scene, std::vector<std::string> more)
    {
        more.insert(more.begin(),
                    {"run", scene, "--headless", "--frames", "2", "--particles", "1500", "--size", "160x90",
                     "--out", in_folder("x.png"), "--stats", in_folder("x.json")});
        const Finished run = run_command(more);
        EXPECT_EQ(run.exit_code, 0) << run.error;
        if (run.exit_code != 0) return {};
        return {image::read_png(in_folder("x.png")).rgb, json::parse(read(in_folder("x.json")))};
    }
};

/// The machine has no device as far as this run can see.
Launch without_device(std::vector<std::string> arguments)
{
    Launch launch;
    launch.arguments = std::move(arguments);
    launch.environment = {"CUDA_VISIBLE_DEVICES="};
    launch.unset = {"LD_LIBRARY_PATH", "LD_PRELOAD"};  // the toolkit's own runtime
    return launch;
}

TEST_F(CudaCommand, DrawsTheProcessorsPictureOnBothWaysToGl)
{
    const std::string canyon = SPINDRIFT_SOURCE_DIR "/scenes/canyon.toml";
    // points by GL on both: tiles, which the processor blends, round less often
    const Drawn cpu = draw(canyon, {"--backend", "cpu", "--flake-path", "raster"});
    const Drawn shared = draw(canyon, {"--backend", "cuda", "--interop", "on"});
    const Drawn copied = draw(canyon, {"--backend", "cuda", "--interop", "off"});
    ASSERT_FALSE(HasFailure());
    EXPECT_GT(cpu.stats.at("draw_list").at("drawn_median"), 100);
    for (const Drawn* drawn : {&shared, &copied})
    {
        EXPECT_EQ(drawn->rgb, cpu.rgb);
        EXPECT_EQ(drawn->stats.at("state_hash"), cpu.stats.at("state_hash"));
        EXPECT_EQ(drawn->stats.at("counts"), cpu.stats.at("counts"));
        EXPECT_EQ(drawn->stats.at("backend").at("name"), "cuda");
        EXPECT_EQ(drawn->stats.at("gl_errors"), "");
    }
    EXPECT_EQ(shared.stats.at("interop").at("shared"), true);
    EXPECT_THAT(shared.stats.at("interop").at("why").get<std::string>(), HasSubstr("probed"));
    EXPECT_THAT(shared.stats.at("flake_memory").get<std::string>(), HasSubstr("in place"));
    EXPECT_EQ(copied.stats.at("interop").at("shared"), false);
    EXPECT_THAT(copied.stats.at("interop").at("why").get<std::string>(), HasSubstr("--interop off"));
    EXPECT_THAT(copied.stats.at("flake_memory").get<std::string>(), HasSubstr("page-locked"));
}

TEST_F(CudaCommand, RefusesStreaksForWhichTheProcessorWouldHaveToReadFlakes)
{
    const Finished run = run_command({"run", small_scene(), "--headless", "--frames", "1", "--out",
                                      in_folder("x.png"), "--backend", "cuda", "--shutter", "0.02"});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.error, HasSubstr("shutter_s"));
}

TEST_F(CudaCommand, RefusesTilesWhichTheProcessorWouldHaveToBlend)
{
    for (const char* interop : {"on", "off"})
    {
        const Finished run =
            run_command({"run", small_scene(), "--headless", "--frames", "1", "--out", in_folder("x.png"),
                         "--backend", "cuda", "--interop", interop, "--flake-path", "tiles"});
        EXPECT_EQ(run.exit_code, 2) << interop;
        EXPECT_THAT(run.error, AllOf(HasSubstr("flake_path"), HasSubstr("raster"))) << interop;
        EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1);
    }
}

TEST_F(CudaCommand, SolvesForTheProcessorsWind)
{
    std::string text = kHouse;
    const std::string kept = "cache_folder = \"kept\"\n";
    text.erase(text.find(kept), kept.size());
    const std::string scene = write("house.toml", text);
    std::string winds[2], hashes[2];
    for (const int cuda : {0, 1})
    {
        const std::string backend = cuda == 1 ? "cuda" : "cpu", out = in_folder(backend + ".nc");
        const Finished wind = run_command({"wind", scene, "-o", out, "--backend", backend});
        ASSERT_EQ(wind.exit_code, 0) << wind.error;
        EXPECT_THAT(wind.output, HasSubstr("multigrid (" + backend + ")"));
        winds[cuda] = read(out);
        const Finished run =
            run_command({"run", scene, "--headless", "--steps", "20", "--hash", "--backend", backend});
        ASSERT_EQ(run.exit_code, 0) << run.error;
        hashes[cuda] = run.output.substr(run.output.find("hash "));
    }
    EXPECT_EQ(winds[1], winds[0]);
    EXPECT_EQ(hashes[1], hashes[0]);
}

TEST_F(CudaCommand, EmbeddedItGivesTheProcessorsFlakesAndPicture)
{
    const SimulationOptions on_host{
        .particles = 700, .width_px = 80, .height_px = 60, .pictures = Pictures::on};
    SimulationOptions on_device = on_host;
    on_device.backend = "cuda";
    Simulation host(small_scene(), on_host), device(small_scene(), on_device);
    EXPECT_THAT(device.backend(), HasSubstr("cuda"));
    for (Simulation* simulation : {&host, &device})
    {
        simulation->advance_to(0.5);
        simulation->draw();
        simulation->write_picture(in_folder(simulation == &host ? "host.png" : "device.png"));
    }
    EXPECT_EQ(device.state_hash(), host.state_hash());
    EXPECT_EQ(device.counts().alive, host.counts().alive);
    EXPECT_GT(device.counts().alive, 100U);
    const FlakeView flakes = device.flakes(), expected = host.flakes();
    ASSERT_EQ(device.slots_used(), device.counts().alive);
    std::map<std::uint32_t, float> height;
    for (std::size_t i = 0; i < host.slots_used(); ++i)
        if ((expected.state[i] & 0xFFU) == 0) height[expected.id[i]] = expected.z[i];
    for (std::size_t i = 0; i < device.slots_used(); ++i) ASSERT_EQ(flakes.z[i], height.at(flakes.id[i]));
    EXPECT_EQ(image::read_png(in_folder("device.png")).rgb.size(), 80U * 60 * 3);

    const std::string snapshot = in_folder("s.snap");
    device.save(snapshot);
    device.advance_to(0.7), host.advance_to(0.7);
    device.load(snapshot);
    device.advance_to(0.7);
    EXPECT_EQ(device.state_hash(), host.state_hash());
    on_device.threads = 2;
    EXPECT_THROW(Simulation(small_scene(), on_device), Error);
}

TEST_F(CudaCommand, StudiesSortsWithTheProcessorsInversionsAndPictures)
{
    const std::string file = in_folder("sorts.json");
    const Finished run =
        run_command({"sorts", "--scene", SPINDRIFT_SOURCE_DIR "/scenes/canyon.toml", "--frames", "3",
                     "--particles", "3000", "--size", "160x90", "--strategies",
                     "bitonic-passes,cub-radix,odd-even-passes", "--out", file});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    std::map<std::string, json> rows;
    const json written = json::parse(read(file));
    for (const json& row : written.at("rows")) rows[row.at("sort")] = row;
    for (const std::string sort : {"bitonic-passes", "odd-even-passes"})
        for (const char* what : {"inversion_fraction", "image_relative_l2"})
        {
            EXPECT_GT(rows.at(sort).at(what), 0) << sort << " " << what;
            EXPECT_EQ(rows.at("cuda/" + sort).at(what), rows.at(sort).at(what)) << sort << " " << what;
        }
    EXPECT_EQ(rows.at("cuda/cub-radix").at("image_relative_l2"), 0);
    EXPECT_GT(rows.at("cuda/cub-radix/16-bit").at("inversion_fraction"), 0);
}

TEST_F(CudaCommand, InfoNamesTheDeviceAndTheWayToGl)
{
    const Finished run = run_command({"info"});
    ASSERT_EQ(run.exit_code, 0) << run.error;
    EXPECT_THAT(run.output, AllOf(HasSubstr("CUDA"), HasSubstr("in place"), HasSubstr("probed")));
}

TEST_F(CudaCommand, AMachineWithoutDevicesIsToldSoInOneLine)
{
    const Finished run = run_command(
        without_device({"run", small_scene(), "--headless", "--steps", "1", "--backend", "cuda"}));
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_THAT(run.error,
                AllOf(HasSubstr("--backend cuda"), HasSubstr("cudaError"), HasSubstr("--backend cpu")));
    EXPECT_EQ(std::count(run.error.begin(), run.error.end(), '\n'), 1);
}

TEST_F(CudaCommand, AutoGoesOnWithoutDevicesAndSaysWhy)
{
    const Finished run = run_command(
        without_device({"run", small_scene(), "--headless", "--steps", "1", "--stats", in_folder("s.json")}));
    ASSERT_EQ(run.exit_code, 0) << run.error;
    const json backend = json::parse(read(in_folder("s.json"))).at("backend");
    EXPECT_EQ(backend.at("name"), "cpu");
    EXPECT_THAT(backend.at("why").get<std::string>(), HasSubstr("cudaError"));
}

}  // namespace

}  // namespace spindrift::test
