// SPDX-License-Identifier: MIT
// Row 11: the projection of winds in odd places.
#include <cmath>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "cpu/wind_projection.h"

namespace spindrift::stress
{
namespace
{

/// Any wind, closed by the solids of `solid`, is finite and free of divergence after its projection.
void expect_divergence_free(const char* name, GridSize n, const std::vector<double>& layers,
                            const std::function<bool(int, int, int)>& solid)
{
    SCOPED_TRACE(name);
    StaggeredWind wind(n, {2, 3, layers[0]}, layers);
    std::mt19937 engine(11);
    std::uniform_real_distribution<double> any(-5, 5);
    for (std::vector<double>* faces : {&wind.u, &wind.v, &wind.w})
        for (double& speed : *faces) speed = any(engine);
    for (int z = 0; z < n.nz; ++z)
        for (int y = 0; y < n.ny; ++y)
            for (int x = 0; x < n.nx; ++x)
                wind.solid[n.index(x, y, z)] = solid(x, y, z) ? std::uint8_t{1} : std::uint8_t{0};
    cpu::make_divergence_free(wind);
    double fastest = 1e-9, worst = 0;
    for (const std::vector<double>* faces : {&wind.u, &wind.v, &wind.w})
        for (const double speed : *faces)
        {
            ASSERT_TRUE(std::isfinite(speed));
            fastest = std::max(fastest, std::abs(speed));
        }
    for (int z = 0; z < n.nz; ++z)
        for (int y = 0; y < n.ny; ++y)
            for (int x = 0; x < n.nx; ++x)
                if (wind.solid[n.index(x, y, z)] == 0)
                    worst = std::max(worst, std::abs(wind.divergence(x, y, z)));
    const double least = std::min({wind.cell_m.x, wind.cell_m.y, wind.cell_m.z});
    EXPECT_LE(worst, 1e-6 * fastest / least);
}

std::vector<double> layers(int n, double first, double growth)
{
    std::vector<double> result;
    for (int i = 0; i < n; ++i) result.push_back(first * std::pow(growth, i));
    return result;
}

TEST(Projection, HoldsInOddPlaces)
{
    const auto free = [](int, int, int) { return false; };
    expect_divergence_free("one cell", {1, 1, 1}, {2}, free);
    expect_divergence_free("one column", {1, 1, 9}, layers(9, 1, 1), free);
    expect_divergence_free("all solid", {5, 4, 3}, layers(3, 1, 1), [](int, int, int) { return true; });
    expect_divergence_free("one solid cell", {1, 1, 1}, {2}, [](int, int, int) { return true; });
    expect_divergence_free("stretched layers", {9, 8, 12}, layers(12, 0.5, 1.3),
                           [](int x, int y, int z) { return x > 3 && x < 6 && y > 2 && y < 5 && z < 5; });
    expect_divergence_free("enclosed voids", {11, 11, 7}, layers(7, 2, 1),
                           [](int x, int y, int z)
                           {
                               const auto shell = [](int v, int lo, int hi) { return v == lo || v == hi; };
                               const bool in = x >= 2 && x <= 8 && y >= 2 && y <= 8 && z >= 1 && z <= 5;
                               return in && (shell(x, 2, 8) || shell(y, 2, 8) || shell(z, 1, 5));
                           });
    expect_divergence_free("sieve", {10, 10, 10}, layers(10, 2, 1.1),
                           [](int x, int y, int z) { return (x * 7 + y * 3 + z * 5) % 3 == 0; });
}

}  // namespace
}  // namespace spindrift::stress
