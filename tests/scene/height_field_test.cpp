// SPDX-License-Identifier: MIT
#include "scene/height_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <png.h>

#include "core/error.h"
#include "cpu/wind_projection.h"
#include "scene/distance.h"
#include "scene/make_world.h"
#include "tests/scene/temporary_folder.h"

namespace spindrift::scene
{
namespace
{

/// A ramp that rises to the east (16 bit) and a dark northern row, 5 x 4 pixels.
std::filesystem::path write_ramp(const TemporaryFolder& folder, unsigned format)
{
    const bool wide = (format & PNG_FORMAT_FLAG_LINEAR) != 0;
    std::vector<std::uint16_t> wide_pixels;
    std::vector<std::uint8_t> pixels;
    const int channels = (format & PNG_FORMAT_FLAG_COLOR) != 0 ? 3 : 1;
    for (int y = 0; y < 4; ++y)
        for (int x = 0; x < 5; ++x)
            for (int c = 0; c < channels; ++c)
            {
                wide_pixels.push_back(static_cast<std::uint16_t>(y == 0 ? 0 : 65535 * x / 4));
                pixels.push_back(static_cast<std::uint8_t>(y == 0 ? 0 : 255 * x / 4));
            }
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    image.width = 5;
    image.height = 4;
    image.format = format;
    const void* data = wide ? static_cast<const void*>(wide_pixels.data()) : pixels.data();
    EXPECT_NE(png_image_write_to_file(&image, (folder / "h.png").c_str(), 0, data, 0, nullptr), 0)
        << image.message;
    return folder / "h.png";
}

Scene scene_with(const std::filesystem::path& file)
{
    Scene scene;
    scene.domain.min_m = {100, 0, 5};
    scene.domain.max_m = {140, 30, 45};
    scene.ground.kind = GroundKind::height_field;
    scene.ground.file = file;
    scene.ground.height_m = 10;
    scene.ground.relief_m = 20;
    scene.camera.keys = {{0, {0, -10, 2}, {0, 0, 2}}};
    return scene;
}

TEST(HeightField, SpansTheDomainWithNorthUp)
{
    for (const unsigned format : {unsigned{PNG_FORMAT_LINEAR_Y}, unsigned{PNG_FORMAT_GRAY}})
    {
        const TemporaryFolder folder;
        const Scene scene = scene_with(write_ramp(folder, format));
        const HeightField heights(scene.ground, scene.domain, {});
        EXPECT_NEAR(heights.height_m(0, 0), 5, 0.05);
        EXPECT_NEAR(heights.height_m(40, 0), 25, 0.05);
        EXPECT_NEAR(heights.height_m(20, 10), 15, 0.05);
        EXPECT_NEAR(heights.height_m(40, 30), 5, 0.05) << "the dark row is the north";
        EXPECT_NEAR(heights.height_m(40, 25), 15, 0.05) << "half way to it";
        EXPECT_NEAR(heights.height_m(999, -999), 25, 0.05) << "held outside";
        const Mesh mesh = heights.mesh();
        EXPECT_EQ(mesh.vertices.size(), 20U);
        EXPECT_FALSE(mesh.solid);
        for (const Vertex& v : mesh.vertices) EXPECT_GT(v.normal.z, 0.4);  // steepest: 20 m in 10 m
    }
}

TEST(HeightField, IsVoxelised)
{
    const TemporaryFolder folder;
    Scene scene = scene_with(write_ramp(folder, PNG_FORMAT_LINEAR_Y));
    scene.ground.surface = {Contact::bounce, 0.5F};
    const World world = make_world(scene, read_geometry(scene), cpu::project_wind());
    const GridSize n{40, 30, 40};
    ASSERT_EQ(world.voxels.nx, 40);
    EXPECT_EQ(world.voxels.clearance[n.index(39, 5, 23)], 0);
    EXPECT_GT(world.voxels.clearance[n.index(39, 5, 26)], 0);
    EXPECT_EQ(world.voxels.clearance[n.index(0, 5, 3)], 0);
    EXPECT_EQ(world.surfaces.at(world.voxels.surface[n.index(0, 5, 3)]).contact, Contact::bounce);
    EXPECT_TRUE(world.has_ground);
    EXPECT_FLOAT_EQ(world.ground_m, 5);
}

TEST(HeightField, RefusesWhatItCannotUse)
{
    const TemporaryFolder folder;
    const auto error_of = [&](const std::filesystem::path& file) -> std::string
    {
        try
        {
            const Scene scene = scene_with(file);
            HeightField(scene.ground, scene.domain, {});
        }
        catch (const Error& error)
        {
            return error.what();
        }
        return "";
    };
    EXPECT_THAT(error_of(folder / "none.png"), ::testing::HasSubstr("no such"));
    EXPECT_THAT(error_of(folder.write("text.png", "hello")), ::testing::HasSubstr("cannot be read"));
    EXPECT_THAT(error_of(write_ramp(folder, PNG_FORMAT_RGB)), ::testing::HasSubstr("coloured"));
    const std::string bytes = read_bytes(write_ramp(folder, PNG_FORMAT_GRAY));
    for (std::size_t length = 0; length + 12 < bytes.size();
         length += 3)  // the last 12 bytes only say that it ends
        EXPECT_NE(error_of(folder.write("cut.png", bytes.substr(0, length))), "") << length;
}

}  // namespace
}  // namespace spindrift::scene
