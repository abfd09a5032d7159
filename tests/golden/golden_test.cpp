// SPDX-License-Identifier: MIT
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <tuple>

#include "gl/context.h"
#include "image/compare.h"
#include "image/write.h"
#include "tests/golden/shipped_scene.h"

// The shipped scenes against pictures kept in pictures/, and against the reference renderer.
// SPINDRIFT_UPDATE_GOLDEN=1 makes the pictures anew (and records the driver) instead of comparing; look at
// them before you commit. A picture binds only the driver that it was made with: software GL rounds by what
// the processor and the Mesa version give. Elsewhere the comparison with the reference alone decides.

namespace spindrift::golden
{
namespace
{

const std::filesystem::path kPictures = SPINDRIFT_SOURCE_DIR "/tests/golden/pictures";

// At most 0.1 % of the pixels more than 3 levels off (docs/decisions/003).
constexpr int kLevels = 3;
constexpr double kShareOff = 1e-3;

/// How near GL must come to the reference, which Showing::most_share_off says: pixels on silhouettes may fall
/// on either side, and the edges of shadows are a texel of the map wide where the reference's are sharp.
constexpr double kMostLevelsOff = 2e-3;  ///< with bloom, tone curve and sRGB on both sides

bool updating()
{
    const char* value = std::getenv("SPINDRIFT_UPDATE_GOLDEN");
    return value != nullptr && std::string(value) == "1";
}

/// A scene and how its flakes are drawn: one picture for both ways.
using ShowingAndPath = std::tuple<Showing, scene::FlakePath>;

std::string name_of(const ShowingAndPath& param)
{
    const bool tiles = std::get<1>(param) == scene::FlakePath::tiles;
    return std::get<0>(param).name + (tiles ? "_tiles" : "_raster");
}

class Golden : public testing::TestWithParam<ShowingAndPath>
{
  protected:
    static void SetUpTestSuite() { context_ = gl::make_headless_context(); }
    static void TearDownTestSuite() { context_.reset(); }

    static std::string driver() { return context_->info().renderer + ", " + context_->info().version; }

    /// The driver that the pictures were made with.
    static std::string recorded_driver()
    {
        std::ifstream file(kPictures / "driver.txt");
        std::string line;
        std::getline(file, line);
        return line;
    }

    static void update(const std::string& name, const image::Image8& picture)
    {
        image::write_png(kPictures / (name + ".png"), picture);
        std::ofstream(kPictures / "driver.txt") << driver() << "\n";
    }

    static std::unique_ptr<gl::Context> context_;
};

std::unique_ptr<gl::Context> Golden::context_;

TEST_P(Golden, LooksAsItDid)
{
    Showing showing = std::get<0>(GetParam());
    showing.path = std::get<1>(GetParam());
    const std::string& name = showing.name;
    const Shown shown = show(showing);
    EXPECT_EQ(shown.errors, "");
    EXPECT_GT(shown.drawn, 0U);

    const image::Difference truth = image::compare(shown.linear, shown.reference, 1e-2);
    fmt::print(
        "{}: {} flakes drawn; reference: {:.3f} % of pixels off by more than 1e-2, relative L2 of the others "
        "{:.2e}\n",
        name_of(GetParam()), shown.drawn, 100 * truth.share_above, truth.rest_relative_l2);
    EXPECT_LE(truth.share_above, showing.most_share_off);
    EXPECT_LE(truth.rest_relative_l2, showing.most_rest);

    // Levels are of 8 bits: light that is off by less than 1e-2 may be several of them in the dark.
    const image::Difference levels = image::compare(shown.display, shown.developed, kLevels);
    fmt::print("{}: {:.3f} % of pixels shown more than {} levels off\n", name_of(GetParam()),
               100 * levels.share_above, kLevels);
    EXPECT_LE(levels.share_above, std::max(kMostLevelsOff, 1.5 * showing.most_share_off));

    const std::string kept = testing::TempDir() + "spindrift-" + name_of(GetParam());
    if (updating() && showing.path == scene::FlakePath::raster)
        update(name, shown.display);
    else if (driver() != recorded_driver())
        fmt::print("{}: the picture is of \"{}\", this driver is \"{}\": only the reference decides\n", name,
                   recorded_driver(), driver());
    else
    {
        const image::Difference off =
            image::compare(shown.display, image::read_png(kPictures / (name + ".png")), kLevels);
        EXPECT_LE(off.share_above, kShareOff)
            << "worst pixel: " << off.worst
            << " levels; if the change is meant: SPINDRIFT_UPDATE_GOLDEN=1 test_golden";
    }
    if (!HasFailure()) return;
    image::write_png(kept + ".png", shown.display);
    image::write_png(kept + "-reference.png", shown.developed);
    ADD_FAILURE() << "see " << kept << ".png and " << kept << "-reference.png beside "
                  << (kPictures / (name + ".png")).string();
}

INSTANTIATE_TEST_SUITE_P(
    Scenes, Golden,
    testing::Combine(testing::Values(Showing{"town", 40'000, 320, 180, 1},
                                     Showing{"canyon", 20'000, 320, 180, 8},
                                     Showing{"sheet", 4'000, 320, 180, 4},
                                     Showing{"calm", 4'000, 320, 180, 1, 5e-3, 2e-3},
                                     Showing{"whiteout", 20'000, 320, 180, 1},
                                     // Bright edges: of lit windows, and of beacons near the eye.
                                     Showing{"squall", 20'000, 320, 180, 2, 2e-3},
                                     // Headlamps graze the road: a texel is long there.
                                     Showing{"night", 20'000, 320, 180, 4, 1.5e-2}),
                     testing::Values(scene::FlakePath::raster, scene::FlakePath::tiles)),
    [](const testing::TestParamInfo<ShowingAndPath>& tested) { return name_of(tested.param); });

}  // namespace
}  // namespace spindrift::golden
