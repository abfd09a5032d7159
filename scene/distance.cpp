// SPDX-License-Identifier: MIT
#include "scene/distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spindrift::scene
{

namespace
{

std::uint8_t one_more(std::uint8_t distance)
{
    return distance == 255 ? distance : static_cast<std::uint8_t>(distance + 1);
}

/// Lowers `nearest` to `row` where that is smaller.
void lower(std::vector<std::uint8_t>& nearest, const std::uint8_t* row)
{
    for (std::size_t x = 0; x < nearest.size(); ++x) nearest[x] = std::min(nearest[x], row[x]);
}

/// One row of a chamfer pass: `nearest` holds the least of the neighbouring rows that the pass has finished.
template <int Direction>
void relax_row(const std::vector<std::uint8_t>& nearest, std::uint8_t* row)
{
    const int n = static_cast<int>(nearest.size());
    for (int x = 0; x < n; ++x)
    {
        const int left = std::max(x - 1, 0), right = std::min(x + 1, n - 1);
        row[x] = std::min(row[x], one_more(std::min({nearest[left], nearest[x], nearest[right]})));
    }
    if constexpr (Direction > 0)
        for (int x = 1; x < n; ++x) row[x] = std::min(row[x], one_more(row[x - 1]));
    else
        for (int x = n - 2; x >= 0; --x) row[x] = std::min(row[x], one_more(row[x + 1]));
}

template <int Direction>
void chamfer_pass(GridSize size, std::span<std::uint8_t> cells)
{
    std::vector<std::uint8_t> nearest(static_cast<std::size_t>(size.nx));
    const auto row = [&](int y, int z) { return &cells[size.index(0, y, z)]; };
    for (int k = 0; k < size.nz; ++k)
    {
        const int z = Direction > 0 ? k : size.nz - 1 - k;
        const bool has_layer = Direction > 0 ? z > 0 : z + 1 < size.nz;
        for (int j = 0; j < size.ny; ++j)
        {
            const int y = Direction > 0 ? j : size.ny - 1 - j;
            std::fill(nearest.begin(), nearest.end(), std::uint8_t{255});
            const int before = y - Direction, after = y + Direction;
            const bool has_before = before >= 0 && before < size.ny,
                       has_after = after >= 0 && after < size.ny;
            if (has_before) lower(nearest, row(before, z));
            if (has_layer) lower(nearest, row(y, z - Direction));
            if (has_layer && has_before) lower(nearest, row(before, z - Direction));
            if (has_layer && has_after) lower(nearest, row(after, z - Direction));
            relax_row<Direction>(nearest, row(y, z));
        }
    }
}

/// Squared distances along one line: the lower envelope of the parabolas (x - i)^2 h^2 + line[i].
class LineTransform
{
  public:
    explicit LineTransform(int longest)
        : site_(static_cast<std::size_t>(longest)),
          from_(static_cast<std::size_t>(longest) + 1),
          result_(static_cast<std::size_t>(longest))
    {
    }

    void run(float* line, std::size_t stride, int n, double spacing_m)
    {
        const double h2 = spacing_m * spacing_m;
        const auto value = [&](int i)
        { return static_cast<double>(line[static_cast<std::size_t>(i) * stride]); };
        const auto meet = [&](int i, int j)
        { return 0.5 * ((value(j) - value(i)) / (h2 * (j - i)) + static_cast<double>(i) + j); };
        int last = -1;
        for (int i = 0; i < n; ++i)
        {
            if (!std::isfinite(value(i))) continue;
            while (last > 0 && meet(site_[last], i) <= from_[last]) --last;
            ++last;
            site_[last] = i;
            from_[last] = last == 0 ? -std::numeric_limits<double>::infinity() : meet(site_[last - 1], i);
        }
        if (last < 0) return;
        for (int i = 0, k = 0; i < n; ++i)
        {
            while (k < last && from_[k + 1] < i) ++k;
            const double d = i - site_[k];
            result_[i] = static_cast<float>(d * d * h2 + value(site_[k]));
        }
        for (int i = 0; i < n; ++i) line[static_cast<std::size_t>(i) * stride] = result_[i];
    }

  private:
    std::vector<int> site_;
    std::vector<double> from_;
    std::vector<float> result_;
};

}  // namespace

void chebyshev_distance(GridSize size, std::span<std::uint8_t> cells)
{
    if (size.count() == 0) return;
    for (std::uint8_t& cell : cells) cell = cell == 0 ? 0 : 255;
    chamfer_pass<1>(size, cells);
    chamfer_pass<-1>(size, cells);
}

std::vector<float> euclidean_distance(GridSize size, Vec3d cell_m, std::span<const std::uint8_t> solid)
{
    std::vector<float> d(size.count());
    for (std::size_t i = 0; i < d.size(); ++i)
        d[i] = solid[i] != 0 ? 0.0F : std::numeric_limits<float>::infinity();
    LineTransform transform(std::max({size.nx, size.ny, size.nz, 1}));
    for (int z = 0; z < size.nz; ++z)
        for (int y = 0; y < size.ny; ++y) transform.run(&d[size.index(0, y, z)], 1, size.nx, cell_m.x);
    for (int z = 0; z < size.nz; ++z)
        for (int x = 0; x < size.nx; ++x)
            transform.run(&d[size.index(x, 0, z)], static_cast<std::size_t>(size.nx), size.ny, cell_m.y);
    const std::size_t layer = static_cast<std::size_t>(size.nx) * static_cast<std::size_t>(size.ny);
    for (int y = 0; y < size.ny; ++y)
        for (int x = 0; x < size.nx; ++x) transform.run(&d[size.index(x, y, 0)], layer, size.nz, cell_m.z);
    for (float& value : d) value = std::sqrt(value);
    return d;
}

}  // namespace spindrift::scene
