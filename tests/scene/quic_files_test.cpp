// SPDX-License-Identifier: MIT
#include "scene/quic_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/error.h"
#include "cpu/wind_projection.h"
#include "scene/make_world.h"
#include "scene/wind_file.h"
#include "tests/scene/temporary_folder.h"

namespace spindrift::scene
{
namespace
{

using ::testing::HasSubstr;

constexpr int kNx = 4, kNy = 3, kNz = 3;  ///< cells of air
constexpr double kCell_m = 2;

/// The three files as QUIC writes them, small: u = 1 + x + 10 z, half as fast in the second time step, v = 1,
/// w = 0, one solid cell at (2, 1, 0).
class QuicFilesTest : public ::testing::Test
{
  protected:
    static std::string cells(int first_layer, const std::function<std::string(int, int, int)>& rest)
    {
        std::string text;
        for (int z = first_layer; z < kNz; ++z)
            for (int y = 0; y < kNy; ++y)
                for (int x = 0; x < kNx; ++x)
                    text += fmt::format(" {:10.5f} {:10.5f} {:10.5f} {}\n", (x + 0.5) * kCell_m,
                                        (y + 0.5) * kCell_m, (z + 0.5) * kCell_m, rest(x, y, z));
        return text;
    }

    static double u(int x, int z) { return 1 + (x + 0.5) * kCell_m + 10 * (z + 0.5) * kCell_m; }

    static std::string velocities(int steps)
    {
        std::string text =
            fmt::format(" %matlab velocity output file\n {:8}       !Number of time steps\n", steps);
        for (int t = 0; t < steps; ++t)
            text += fmt::format(
                        " % Begin Output for new time step\n {:8}       !Time Increment\n {:8.4f}     "
                        "  !Time\n",
                        t + 1, 6 + 0.5 * t) +
                    cells(-1,
                          [&](int x, int, int z)
                          {
                              return z < 0 ? std::string("0.00000 0.00000 0.00000")
                                           : fmt::format("{:10.5f} {:10.5f} {:10.5f}", u(x, z) / (1 + t), 1.0,
                                                         0.0);
                          });
        return text;
    }

    static std::string kinds()
    {
        return cells(-1,
                     [](int x, int y, int z) { return z < 0 || (x == 2 && y == 1 && z == 0) ? "0" : "1"; });
    }

    static std::string turbulence()
    {
        return "TITLE     = \"TURBULENCE in 3D\"\n"
               "VARIABLES = \"X\" \"Y\" \"Z\" \"SIGU\" \"SIGV\" \"SIGW\" \"LZ\" \"LEFF\" \"EPS\" \"UV\" "
               "\"UW\" \"VW\"\n"
               "ZONE T = \"TURBULENCE\" \nI=     4, J=     3,  K=     3, F=POINT\n"
               "DT=(SINGLE SINGLE SINGLE SINGLE SINGLE SINGLE SINGLE SINGLE SINGLE SINGLE SINGLE SINGLE)\n" +
               cells(0,
                     [](int, int, int z)
                     {
                         return fmt::format(
                             "2.0E+00 1.0E+00 5.0E-01 2.0E-01 5.0E-01 {} 1.0E-02 -2.0E-01 3.0E-02",
                             0.1 * (z + 1));
                     });
    }

    void write(const std::string& velocity, const std::string& kind, const std::string& stress = turbulence())
    {
        folder.write("QU_velocity.dat", velocity);
        folder.write("QU_celltype.dat", kind);
        folder.write("QP_turbfield.dat", stress);
    }

    std::vector<WindSlice> read() const
    {
        return read_wind_file(folder / "QU_velocity.dat", folder / "QP_turbfield.dat");
    }

    std::string error() const
    {
        try
        {
            read();
        }
        catch (const Error& error)
        {
            return error.what();
        }
        return "";
    }

    TemporaryFolder folder;
};

TEST_F(QuicFilesTest, PutsVelocitiesOfCellsOnFacesAboveTheGround)
{
    write(velocities(1), kinds());
    const WindSlice slice = read().at(0);
    const StaggeredWind& wind = slice.wind;
    EXPECT_EQ(wind.size.nx, kNx);
    EXPECT_EQ(wind.size.ny, kNy);
    EXPECT_EQ(wind.size.nz, kNz);
    EXPECT_DOUBLE_EQ(wind.cell_m.x, kCell_m);
    EXPECT_NEAR(wind.u[wind.u_size().index(1, 0, 1)], 0.5 * (u(0, 1) + u(1, 1)), 1e-4) << "between two cells";
    EXPECT_NEAR(wind.u[wind.u_size().index(0, 0, 1)], u(0, 1), 1e-4) << "at the border";
    EXPECT_EQ(wind.solid[wind.size.index(2, 1, 0)], 1);
    EXPECT_EQ(std::count(wind.solid.begin(), wind.solid.end(), 1), 1) << "the layer under the ground is gone";
    EXPECT_EQ(wind.u[wind.u_size().index(2, 1, 0)], 0) << "a face of a solid cell";
    EXPECT_EQ(wind.v[wind.v_size().index(2, 1, 0)], 0);
    EXPECT_NEAR(wind.v[wind.v_size().index(2, 1, 1)], 1, 1e-6);
}

TEST_F(QuicFilesTest, TurnsSigmasAlongTheWindAndKeepsTheSignsOfCovariances)
{
    write(velocities(1), kinds());
    const WindSlice slice = read().at(0);
    ASSERT_EQ(slice.stress.size(), slice.wind.size.count());
    const std::size_t i = slice.wind.size.index(1, 2, 1);
    const double speed = std::hypot(u(1, 1), 1), c = u(1, 1) / speed, s = 1 / speed;
    EXPECT_NEAR(slice.stress[i].xx, 4 * c * c + s * s, 1e-5);
    EXPECT_NEAR(slice.stress[i].yy, 4 * s * s + c * c, 1e-5);
    EXPECT_NEAR(slice.stress[i].zz, 0.25, 1e-6);
    EXPECT_NEAR(slice.stress[i].xy, 0.01, 1e-6);
    EXPECT_NEAR(slice.stress[i].xz, -0.2, 1e-6);
    EXPECT_NEAR(slice.stress[i].yz, 0.03, 1e-6);
    EXPECT_NEAR(slice.c0_eps[i], 5.7 * 0.2, 1e-5);
}

TEST_F(QuicFilesTest, CountsTimesFromTheFirstInSeconds)
{
    write(velocities(3), kinds());
    const std::vector<WindSlice> slices = read();
    ASSERT_EQ(slices.size(), 3U);
    for (int t = 0; t < 3; ++t)
    {
        EXPECT_NEAR(slices[t].time_s, 1800.0 * t, 1e-6);
        EXPECT_NEAR(slices[t].wind.u[0], u(0, 0) / (1 + t), 1e-4);
        EXPECT_EQ(slices[t].stress.size(), slices[0].stress.size());
    }
}

TEST_F(QuicFilesTest, BecomeAWindThatChangesAndIsBelievedOnlyWhereAsked)
{
    write(velocities(2), kinds());
    Scene scene;
    scene.domain.max_m = {kNx * kCell_m, kNy * kCell_m, kNz * kCell_m};
    scene.capacity = 10;
    scene.camera.keys = {{0, {0, -10, 2}, {0, 0, 2}}};
    scene.wind.source = WindSource::file;
    scene.wind.winds_file = folder / "QU_velocity.dat";
    scene.wind.turbulence_file = folder / "QP_turbfield.dat";
    const auto world = [&] { return make_world(scene, read_geometry(scene), cpu::project_wind()); };
    scene.wind.project = false;
    const Wind believed = world().wind;
    ASSERT_EQ(believed.later.size(), 1U);
    EXPECT_DOUBLE_EQ(believed.later[0].time_s, 1800);
    const std::size_t i = GridSize{kNx, kNy, kNz}.index(0, 0, 2);
    const auto of_file = static_cast<float>(0.75 * u(0, 2) + 0.25 * u(1, 2));  // its two faces
    EXPECT_NEAR(believed.cells[i].u, of_file, 1e-4);
    EXPECT_NEAR(believed.later[0].cells[i].u, 0.5F * of_file, 1e-4);
    EXPECT_GT(believed.cells[i].s11, 0);
    scene.wind.project = true;
    EXPECT_GT(std::abs(world().wind.cells[i].u - of_file), 0.01F) << "the file's wind has divergence";
}

TEST_F(QuicFilesTest, SaysWhatIsWrongAndWhere)
{
    const auto with = [&](std::string text, const std::string& from, const std::string& to)
    {
        const std::size_t at = text.find(from);
        EXPECT_NE(at, std::string::npos);
        return text.replace(at, from.size(), to);
    };
    const std::string sound = velocities(1);
    write(sound.substr(0, sound.size() - 200), kinds());
    EXPECT_THAT(error(), HasSubstr("may be cut off"));
    write(with(sound, "1       !Number", "0       !Number"), kinds());
    EXPECT_THAT(error(), HasSubstr("0 time steps; 1 to 10000 are allowed"));
    write(with(sound, "1       !Number", "2       !Number"), kinds());
    EXPECT_THAT(error(), HasSubstr("time step 2 of 2 is missing"));
    write(with(sound, "0.00000 0.00000 0.00000", "0.00000 nan 0.00000"), kinds());
    EXPECT_THAT(error(), HasSubstr("QU_velocity.dat:6: '"));
    EXPECT_THAT(error(), HasSubstr("no line of 6 finite numbers"));
    write(with(sound, "   7.00000    5.00000    5.00000", "   7.50000    5.00000    5.00000"), kinds());
    EXPECT_THAT(error(), HasSubstr("is not where a grid of 2 x 2 x 2 m cells has it"));
    write(sound, kinds() + " 1 1 1 1\n");
    EXPECT_THAT(error(), HasSubstr("QU_celltype.dat"));
    write(sound, kinds(), with(turbulence(), "TITLE", "title"));
    EXPECT_THAT(error(), HasSubstr("name a QP_turbfield.dat"));
    write(sound, kinds(), "");
    EXPECT_THAT(error(), HasSubstr("name a QP_turbfield.dat"));
    write("", kinds());
    EXPECT_THAT(error(), HasSubstr("name a QU_velocity.dat"));
    write(sound, kinds());
    std::filesystem::remove(folder / "QU_celltype.dat");
    EXPECT_THAT(error(), HasSubstr("QU_celltype.dat: no such wind file"));
}

}  // namespace
}  // namespace spindrift::scene
