// SPDX-License-Identifier: MIT
#include "scene/wind_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <netcdf.h>

#include <cmath>
#include <functional>
#include <map>

#include "core/error.h"
#include "core/philox.h"
#include "cpu/wind_projection.h"
#include "tests/scene/temporary_folder.h"

namespace spindrift::scene
{
namespace
{

using ::testing::HasSubstr;

/// A pair of files as QES-Winds writes them, small; what a test needs otherwise is changed before writing.
struct SmallWind
{
    std::size_t nx = 4, ny = 3, nz = 5, slices = 1;  ///< cells; nz without the ghost layer
    std::vector<double> dz = std::vector<double>(6, 2.0);
    std::string left_out;  ///< a variable that is not written
    std::string broken;    ///< a variable that gets a NaN
    bool dz_array = true;
    bool falling_times = false;
    bool growing_building = false;  ///< in the later slices

    static double u(std::size_t slice, double x, double z)
    {
        return 1 + static_cast<double>(slice) * 100 + 0.1 * x + z;
    }

    void write_winds(const std::filesystem::path& file) const
    {
        const std::size_t cells_z = nz + 1;
        int id = 0;
        ASSERT_EQ(nc_create(file.c_str(), NC_NETCDF4 | NC_CLOBBER, &id), NC_NOERR);
        std::map<std::string, int> dim;
        for (const auto& [name, length] : std::map<std::string, std::size_t>{{"t", slices},
                                                                             {"x", nx},
                                                                             {"y", ny},
                                                                             {"z", cells_z},
                                                                             {"x_face", nx + 1},
                                                                             {"y_face", ny + 1},
                                                                             {"z_face", cells_z + 1}})
            nc_def_dim(id, name.c_str(), length, &dim[name]);
        const auto put =
            [&](const std::string& name, std::vector<std::string> dims, const std::vector<float>& given)
        {
            if (name == left_out) return;
            std::vector<int> ids;
            for (const auto& d : dims) ids.push_back(dim[d]);
            std::vector<float> values = given;
            if (name == broken) values[values.size() / 2] = NAN;
            int variable = 0;
            nc_def_var(id, name.c_str(), NC_FLOAT, static_cast<int>(ids.size()), ids.data(), &variable);
            ASSERT_EQ(nc_put_var_float(id, variable, values.data()), NC_NOERR);
        };
        std::vector<float> x, y, z, thickness;
        for (std::size_t i = 0; i < nx; ++i) x.push_back(static_cast<float>(2 * i + 1));
        for (std::size_t j = 0; j < ny; ++j) y.push_back(static_cast<float>(2 * j + 1));
        double low = -dz[0];
        for (std::size_t k = 0; k < cells_z; ++k)
        {
            thickness.push_back(static_cast<float>(dz[k]));
            z.push_back(static_cast<float>(low + 0.5 * dz[k]));
            low += dz[k];
        }
        put("x", {"x"}, x);
        put("y", {"y"}, y);
        put("z", {"z"}, z);
        if (dz_array) put("dz_array", {"z"}, thickness);
        std::vector<float> times;
        for (std::size_t t = 0; t < slices; ++t)
            times.push_back(falling_times ? 5.0F : 100 + 10 * static_cast<float>(t));
        put("t", {"t"}, times);
        std::vector<float> u, zero, flag;
        for (std::size_t t = 0; t < slices; ++t)
        {
            for (std::size_t k = 0; k <= cells_z; ++k)
                for (std::size_t j = 0; j <= ny; ++j)
                    for (std::size_t i = 0; i <= nx; ++i)
                    {
                        u.push_back(static_cast<float>(
                            k == cells_z || j == ny ? 999 : Self::u(t, 2.0 * static_cast<double>(i), z[k])));
                        zero.push_back(0);
                    }
            for (std::size_t k = 0; k < cells_z; ++k)
                for (std::size_t j = 0; j < ny; ++j)
                    for (std::size_t i = 0; i < nx; ++i)
                        flag.push_back(k == 0                       ? 2.0F
                                       : k == 1 && i == 2 && j == 1 ? 0.0F
                                       : k == 2 && i == 0 && j == 0 ? 2.0F
                                       : growing_building && t > 0  ? 0.0F
                                                                    : 4.0F);
        }
        const std::vector<std::string> faces{"t", "z_face", "y_face", "x_face"};
        put("u", faces, u);
        put("v", faces, zero);
        put("w", faces, zero);
        put("icellflag", {"t", "z", "y", "x"}, flag);
        nc_close(id);
    }

    void write_turbulence(const std::filesystem::path& file) const
    {
        int id = 0;
        ASSERT_EQ(nc_create(file.c_str(), NC_NETCDF4 | NC_CLOBBER, &id), NC_NOERR);
        int dims[4];
        nc_def_dim(id, "t", 1, &dims[0]);
        nc_def_dim(id, "z", nz + 1, &dims[1]);
        nc_def_dim(id, "y", ny, &dims[2]);
        nc_def_dim(id, "x", nx, &dims[3]);
        for (const char* name : {"txx", "txy", "txz", "tyy", "tyz", "tzz", "CoEps"})
        {
            if (name == left_out) continue;
            int variable = 0;
            nc_def_var(id, name, NC_FLOAT, 4, dims, &variable);
            std::vector<float> values;
            for (std::size_t k = 0; k <= nz; ++k)
                values.insert(values.end(), nx * ny, static_cast<float>(name[1]) + static_cast<float>(k));
            nc_put_var_float(id, variable, values.data());
        }
        nc_close(id);
    }

    using Self = SmallWind;
};

class WindFileTest : public ::testing::Test
{
  protected:
    WindSlice read(const SmallWind& small, bool turbulence = false)
    {
        return read_all(small, turbulence).at(0);
    }

    std::vector<WindSlice> read_all(const SmallWind& small, bool turbulence = false)
    {
        small.write_winds(folder / "w.nc");
        if (turbulence) small.write_turbulence(folder / "t.nc");
        return read_wind_file(folder / "w.nc", turbulence ? folder / "t.nc" : std::filesystem::path());
    }

    std::string error_of(const SmallWind& small, bool turbulence = false)
    {
        try
        {
            read(small, turbulence);
        }
        catch (const Error& error)
        {
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder;
};

TEST_F(WindFileTest, ReadsFacesWithoutGhostLayerAndPadding)
{
    const WindSlice file = read(SmallWind{});
    EXPECT_EQ(file.wind.size.nx, 4);
    EXPECT_EQ(file.wind.size.ny, 3);
    EXPECT_EQ(file.wind.size.nz, 5);
    EXPECT_DOUBLE_EQ(file.wind.cell_m.z, 2);
    for (int k = 0; k < 5; ++k)
        for (int i = 0; i <= 4; ++i)
            EXPECT_NEAR(file.wind.u[file.wind.u_size().index(i, 2, k)], SmallWind::u(0, 2 * i, 2 * k + 1),
                        1e-5);
    EXPECT_EQ(file.wind.solid[file.wind.size.index(2, 1, 0)], 1) << "a building";
    EXPECT_EQ(file.wind.solid[file.wind.size.index(0, 0, 1)], 1) << "terrain";
    EXPECT_EQ(std::count(file.wind.solid.begin(), file.wind.solid.end(), 1), 2);
    EXPECT_TRUE(file.stress.empty());
}

TEST_F(WindFileTest, ReadsEveryTimeSlice)
{
    SmallWind small;
    small.slices = 3;
    const std::vector<WindSlice> slices = read_all(small, true);
    ASSERT_EQ(slices.size(), 3U);
    for (std::size_t t = 0; t < 3; ++t)
    {
        EXPECT_DOUBLE_EQ(slices[t].time_s, 10.0 * static_cast<double>(t)) << "counted from the first";
        EXPECT_NEAR(slices[t].wind.u[0], SmallWind::u(t, 0, 1), 1e-4);
        ASSERT_EQ(slices[t].stress.size(), 60U) << "turbulence of one slice holds for all";
        EXPECT_FLOAT_EQ(slices[t].stress[0].xx, 'x' + 1);
    }
}

TEST_F(WindFileTest, RefusesTimesThatDoNotRiseAndSolidsThatChange)
{
    SmallWind small;
    small.slices = 2;
    small.falling_times = true;
    EXPECT_THAT(error_of(small), HasSubstr("'t' has 5 as time 1"));
    small.falling_times = false;
    small.growing_building = true;
    EXPECT_THAT(error_of(small), HasSubstr("solid cells (icellflag) change"));
    small.growing_building = false;
    small.left_out = "t";
    EXPECT_THAT(error_of(small), HasSubstr("'t' is missing"));
}

TEST_F(WindFileTest, ReadsStressesAboveTheGhostLayer)
{
    const WindSlice file = read(SmallWind{}, true);
    ASSERT_EQ(file.stress.size(), 60U);
    EXPECT_FLOAT_EQ(file.stress[0].xx, 'x' + 1);
    EXPECT_FLOAT_EQ(file.stress[0].yz, 'y' + 1);
    EXPECT_FLOAT_EQ(file.c0_eps[59], 'o' + 5);
}

TEST_F(WindFileTest, BringsUnevenLayersToTheThinnest)
{
    SmallWind small;
    small.dz = {1, 1, 1, 2, 2, 4};
    for (const bool dz_array : {true, false})
    {
        small.dz_array = dz_array;
        const WindSlice file = read(small);
        EXPECT_EQ(file.wind.size.nz, 10);
        EXPECT_NEAR(file.wind.cell_m.z, 1, 1e-6);
        for (int k = 0; k < 8; ++k)  // the highest centre of the file is at 8 m
            EXPECT_NEAR(file.wind.u[file.wind.u_size().index(1, 1, k)], SmallWind::u(0, 2, k + 0.5), 1e-4)
                << k;
        EXPECT_EQ(file.wind.solid[file.wind.size.index(2, 1, 0)], 1);
    }
}

TEST_F(WindFileTest, SaysWhichVariableIsMissingOrBroken)
{
    for (const char* name : {"u", "w", "icellflag", "x"})
    {
        SmallWind small;
        small.left_out = name;
        EXPECT_THAT(error_of(small), HasSubstr(std::string("'") + name + "' is missing"));
    }
    for (const char* name : {"u", "icellflag", "dz_array"})
    {
        SmallWind small;
        small.broken = name;
        EXPECT_THAT(error_of(small), HasSubstr("not sound")) << name;
    }
    SmallWind small;
    small.left_out = "tyz";
    EXPECT_THAT(error_of(small, true), HasSubstr("'tyz' is missing"));
}

TEST_F(WindFileTest, RefusesTurbulenceOfAnotherGrid)
{
    SmallWind small, other;
    other.nx = 7;
    small.write_winds(folder / "w.nc");
    other.write_turbulence(folder / "t.nc");
    EXPECT_THROW(read_wind_file(folder / "w.nc", folder / "t.nc"), Error);
    EXPECT_THROW(read_wind_file(folder / "t.nc", {}), Error) << "the files in each other's place";
}

TEST_F(WindFileTest, RefusesWhatIsNoWindFile)
{
    EXPECT_THROW(read_wind_file(folder / "none.nc", {}), Error);
    EXPECT_THROW(read_wind_file(folder.path(), {}), Error);
    EXPECT_THROW(read_wind_file(folder.write("text.nc", "hello"), {}), Error);
    EXPECT_THROW(read_wind_file(folder.write("empty.nc", ""), {}), Error);
    SmallWind{}.write_winds(folder / "w.nc");
    const std::string bytes = read_bytes(folder / "w.nc");
    for (std::size_t part = 1; part < 20; ++part)
        EXPECT_THROW(read_wind_file(folder.write("cut.nc", bytes.substr(0, bytes.size() * part / 20)), {}),
                     Error)
            << part;
}

TEST_F(WindFileTest, SurvivesAnyByteThatIsWrong)
{
    SmallWind{}.write_winds(folder / "w.nc");
    const std::string sound = read_bytes(folder / "w.nc");
    int refused = 0;
    for (std::uint32_t trial = 0; trial < 60; ++trial)
    {
        std::string broken = sound;
        const Philox4<std::uint32_t> draw = philox<std::uint32_t>(9, {trial, 1, 2, 3});
        for (std::uint32_t flips = 0; flips <= draw.x2 % 4; ++flips)
            broken[(draw.x0 + flips * draw.x3) % broken.size()] = static_cast<char>(draw.x1 >> (8 * flips));
        try
        {
            read_wind_file(folder.write("broken.nc", broken), {});
        }
        catch (const Error&)
        {
            ++refused;
        }
    }
    EXPECT_GT(refused, 5);  // the library itself dies on some of these files
}

TEST(RealWindFile, IsFreeOfDivergenceAfterwards)
{
    const auto winds = optional_data("qes/TwoBuildings_windsWk.nc");
    if (winds.empty())
        GTEST_SKIP() << "no qes/TwoBuildings_windsWk.nc: set SPINDRIFT_TEST_DATA to a folder that holds it";
    WindSlice file = std::move(read_wind_file(winds, {})[0]);
    const Vec3f before = file.wind.centre(60, 22, 20);
    const Projection done = cpu::make_divergence_free(file.wind);
    EXPECT_GT(done.before_per_s, 0.1) << "the file's own";
    EXPECT_LT(done.after_per_s, 2e-6 * 10 / 4);
    const Vec3f after = file.wind.centre(60, 22, 20);
    EXPECT_NEAR(after.x, before.x, 0.5);
    RecordProperty("divergence_before_per_s", std::to_string(done.before_per_s));
    RecordProperty("iterations", done.iterations);
}

TEST(RealWindFile, CellCentredPictureFileIsToldApart)
{
    const auto winds = optional_data("qes/TwoBuildings_windsOut.nc");
    if (winds.empty())
        GTEST_SKIP() << "no qes/TwoBuildings_windsOut.nc: set SPINDRIFT_TEST_DATA to a folder that holds it";
    try
    {
        read_wind_file(winds, {});
        FAIL();
    }
    catch (const Error& error)
    {
        EXPECT_THAT(error.what(), HasSubstr("windsWk"));
    }
}

}  // namespace
}  // namespace spindrift::scene
