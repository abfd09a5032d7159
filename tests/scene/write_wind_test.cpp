// SPDX-License-Identifier: MIT
#include "scene/write_wind.h"

#include <gtest/gtest.h>
#include <netcdf.h>

#include "core/error.h"
#include "core/turbulence.h"
#include "cpu/wind_projection.h"
#include "scene/wind_file.h"
#include "tests/scene/small_scene.h"
#include "tests/scene/temporary_folder.h"

namespace spindrift::scene
{
namespace
{

GriddedWind solved_wind()
{
    const Scene scene = parse(changed("max_m = [10, 10, 10]", "max_m = [24, 20, 16]") +
                              "[wind]\nsource = \"solve\"\nspeed_m_s = 4\ncell_m = 2\n"
                              "[[box]]\nmin_m = [8, 6, 0]\nmax_m = [14, 12, 6]\n");
    GriddedWind wind;
    make_world(scene, {}, cpu::project_wind(), &wind);
    return wind;
}

TEST(WriteWind, IsReadBackAsWindsAndAsTurbulence)
{
    const TemporaryFolder folder;
    const GriddedWind wind = solved_wind();
    write_wind(folder / "new/wind.nc", wind, {0, 0, 0});
    const WindSlice read = read_wind_file(folder / "new/wind.nc", folder / "new/wind.nc")[0];
    const StaggeredWind& faces = wind.solved.wind;
    EXPECT_EQ(read.wind.size.nx, 12);
    EXPECT_EQ(read.wind.size.nz, 8);
    EXPECT_NEAR(read.wind.cell_m.z, 2, 1e-6);
    EXPECT_EQ(read.wind.u, faces.u) << "rounded to float before it was written";
    EXPECT_EQ(read.wind.v, faces.v);
    EXPECT_EQ(read.wind.w, faces.w);
    EXPECT_EQ(read.wind.solid, faces.solid);
    ASSERT_EQ(read.stress.size(), wind.flow.stress.size());
    for (std::size_t i = 0; i < read.stress.size(); ++i)
    {
        const Stress<float>& t = read.stress[i];
        ASSERT_FLOAT_EQ(read.c0_eps[i], wind.flow.c0_eps[i]);
        ASSERT_GE(t.xx, 0) << "realizable";
        ASSERT_LE(t.xz * t.xz, t.xx * t.zz * 1.0001F);
        if (faces.solid[i] == 0 && i % 12 == 0)
        {
            ASSERT_LE(t.xz, 0) << "momentum goes down before the house";
        }
    }
    const auto files = std::distance(std::filesystem::directory_iterator(folder / "new"), {});
    EXPECT_EQ(files, 1) << "nothing is left aside";
}

/// Dimensions and variables that QES-Plume asks for, and those by which CF readers find their way.
TEST(WriteWind, HasTheLayoutThatItsReadersExpect)
{
    const TemporaryFolder folder;
    write_wind(folder / "wind.nc", solved_wind(), {100, 200, 3});
    int id = 0;
    ASSERT_EQ(nc_open((folder / "wind.nc").c_str(), NC_NOWRITE, &id), NC_NOERR);
    const std::pair<const char*, std::size_t> lengths[] = {
        {"t", 1}, {"x", 12}, {"y", 10}, {"z", 9}, {"x_face", 13}, {"y_face", 11}, {"z_face", 10}};
    for (const auto& [name, expected] : lengths)
    {
        int dimension = 0;
        std::size_t length = 0;
        ASSERT_EQ(nc_inq_dimid(id, name, &dimension), NC_NOERR) << name;
        nc_inq_dimlen(id, dimension, &length);
        EXPECT_EQ(length, expected) << name;
    }
    for (const char* name : {"t", "x", "y", "z", "z_face", "u", "v", "w", "icellflag", "txx", "txy", "txz",
                             "tyy", "tyz", "tzz", "CoEps", "tke"})
    {
        int variable = 0;
        EXPECT_EQ(nc_inq_varid(id, name, &variable), NC_NOERR) << name;
    }
    char text[64] = "";
    EXPECT_EQ(nc_get_att_text(id, NC_GLOBAL, "Conventions", text), NC_NOERR);
    EXPECT_EQ(std::string(text), "CF-1.8");
    float low = 0, wind = 0;
    int variable = 0;
    const std::size_t first = 0, above[4] = {0, 6, 0, 0}, ground[4] = {0, 0, 3, 3};
    nc_inq_varid(id, "z", &variable);
    nc_get_var1_float(id, variable, &first, &low);
    EXPECT_EQ(low, -1) << "the layer under the ground";
    nc_inq_varid(id, "eastward_wind", &variable);
    nc_get_var1_float(id, variable, above, &wind);
    EXPECT_GT(wind, 3);
    int flag = 0;
    nc_inq_varid(id, "icellflag", &variable);
    nc_get_var1_int(id, variable, ground, &flag);
    EXPECT_EQ(flag, 2);
    const std::size_t inside[4] = {0, 1, 3, 4};
    nc_get_var1_int(id, variable, inside, &flag);
    EXPECT_EQ(flag, 0);
    nc_close(id);
}

TEST(WriteWind, LeavesNothingWhereItCannotWrite)
{
    const TemporaryFolder folder;
    folder.write("file", "");
    EXPECT_THROW(write_wind(folder / "file/wind.nc", solved_wind(), {0, 0, 0}), Error);
    EXPECT_THROW(write_wind("/proc/none/wind.nc", solved_wind(), {0, 0, 0}), Error);
}

}  // namespace
}  // namespace spindrift::scene
