// SPDX-License-Identifier: MIT
#include "core/wind_states.h"

#include <vector>

#include <gtest/gtest.h>

#include "core/check_world.h"

namespace spindrift
{
namespace
{

/// Two cells whose sixteen numbers are all `value` and `value` + 1.
std::vector<WindCell> two_cells(float value)
{
    std::vector<WindCell> cells(2);
    for (int i = 0; i < 2; ++i)
        for (int n = 0; n < 16; ++n)
            (&cells[static_cast<std::size_t>(i)].u)[n] = value + static_cast<float>(i);
    return cells;
}

TEST(WindStates, MixEveryNumberByTimeAndHoldAtBothEnds)
{
    std::vector<WindCell> all;
    for (const float value : {10.0F, 20.0F, 60.0F})
        for (const WindCell& c : two_cells(value)) all.push_back(c);
    const std::vector<double> times{0, 4, 6};
    std::vector<WindCell> now(2);
    const WindStates winds{all.data(), times.data(), 3, 2, now.data()};
    for (const auto& [time_s, expected] : {std::pair{-1.0, 10.0F},
                                           {0.0, 10.0F},
                                           {1.0, 12.5F},
                                           {4.0, 20.0F},
                                           {5.5, 50.0F},
                                           {6.0, 60.0F},
                                           {1e9, 60.0F}})
        for (std::size_t i = 0; i < 2; ++i)
        {
            mix_cell(winds, moment_of(winds, time_s), i);
            for (int n = 0; n < 16; ++n)
                EXPECT_FLOAT_EQ((&now[i].u)[n], expected + static_cast<float>(i)) << time_s << " s";
        }
}

TEST(WindStates, MustFitTheGridAndRise)
{
    World world;
    world.wind.kind = WindKind::grid;
    world.wind.nx = 2, world.wind.ny = world.wind.nz = 1;
    world.wind.cells = two_cells(1);
    world.wind.later = {{1, two_cells(2)}, {2, two_cells(3)}};
    world.capacity = 1;
    EXPECT_NO_THROW(check_world(world));
    world.wind.later[1].time_s = 1;
    EXPECT_THROW(check_world(world), Error) << "the same time twice";
    world.wind.later[1].time_s = 2;
    world.wind.later[0].cells.pop_back();
    EXPECT_THROW(check_world(world), Error);
}

}  // namespace
}  // namespace spindrift
