// SPDX-License-Identifier: MIT
#include "scene/voxelise.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/error.h"
#include "scene/triangle_cells.h"

namespace spindrift::scene
{

namespace
{

/// Cells of a mesh's own grid while it is filled.
enum class Cell : std::uint8_t
{
    unknown,
    shell,   ///< touched by a triangle
    closed,  ///< under the floor: neither solid nor a way in
    outside,
};

/// Triangles are drawn in by this share of a cell, along their plane and against their normal, so that faces
/// which lie exactly on the border of a cell do not take the cell on its far side.
constexpr double kInset = 1e-3;

struct Range
{
    std::array<std::int64_t, 3> low,
        high;  ///< cells of the domain's grid, high exclusive; may lie outside of it

    double count() const
    {
        double n = 1;
        for (int a = 0; a < 3; ++a) n *= static_cast<double>(std::max<std::int64_t>(high[a] - low[a], 0));
        return n;
    }
};

/// A mesh on the lattice of the domain's grid, one empty cell all round.
class MeshFill
{
  public:
    MeshFill(const Mesh& mesh, const Range& range, double cell_m, const Voxeliser::Height& floor_m)
        : range_(range),
          size_{static_cast<int>(range.high[0] - range.low[0]),
                static_cast<int>(range.high[1] - range.low[1]),
                static_cast<int>(range.high[2] - range.low[2])},
          cells_(size_.count(), Cell::unknown)
    {
        for (const MeshPart& part : mesh.parts)
            for (std::size_t i = 0; i + 2 < part.indices.size(); i += 3) mark(mesh, &part.indices[i], cell_m);
        if (floor_m) close_below(floor_m, cell_m);
        flood();
    }

    template <class Take>
    void each_solid(Take take) const
    {
        std::size_t i = 0;
        for (int z = 0; z < size_.nz; ++z)
            for (int y = 0; y < size_.ny; ++y)
                for (int x = 0; x < size_.nx; ++x, ++i)
                    if (cells_[i] != Cell::outside && cells_[i] != Cell::closed)
                        take(x + range_.low[0], y + range_.low[1], z + range_.low[2]);
    }

  private:
    void mark(const Mesh& mesh, const std::uint32_t* index, double cell_m)
    {
        std::array<Vec3d, 3> p;
        for (int k = 0; k < 3; ++k)
        {
            const Vec3f& v = mesh.vertices[index[k]].position_m;
            p[k] = {v.x / cell_m - static_cast<double>(range_.low[0]),
                    v.y / cell_m - static_cast<double>(range_.low[1]),
                    v.z / cell_m - static_cast<double>(range_.low[2])};
        }
        inset(p);
        const TriangleCells triangle(p[0], p[1], p[2]);
        const Vec3d low = triangle.low(), high = triangle.high();
        const auto first = [](double v, int n)
        { return static_cast<int>(std::clamp(std::floor(v), 0.0, static_cast<double>(n))); };
        const auto end = [](double v, int n)
        { return static_cast<int>(std::clamp(std::floor(v) + 1, 0.0, static_cast<double>(n))); };
        for (int z = first(low.z, size_.nz); z < end(high.z, size_.nz); ++z)
            for (int y = first(low.y, size_.ny); y < end(high.y, size_.ny); ++y)
                for (int x = first(low.x, size_.nx); x < end(high.x, size_.nx); ++x)
                    if (Cell& cell = cells_[size_.index(x, y, z)];
                        cell != Cell::shell && triangle.touches(x, y, z))
                        cell = Cell::shell;
    }

    static void inset(std::array<Vec3d, 3>& p)
    {
        const Vec3d n = cross(p[1] - p[0], p[2] - p[0]);
        const double length = std::sqrt(dot(n, n));
        const Vec3d centre = (p[0] + p[1] + p[2]) * (1.0 / 3.0);
        for (Vec3d& corner : p)
        {
            const Vec3d inward = centre - corner;
            const double reach = std::sqrt(dot(inward, inward));
            if (reach > 0) corner = corner + inward * std::min(kInset / reach, 0.5);
            if (length > 0) corner = corner - n * (kInset / length);
        }
    }

    void close_below(const Voxeliser::Height& floor_m, double cell_m)
    {
        for (int y = 0; y < size_.ny; ++y)
            for (int x = 0; x < size_.nx; ++x)
            {
                const double at_x = (static_cast<double>(x + range_.low[0]) + 0.5) * cell_m;
                const double at_y = (static_cast<double>(y + range_.low[1]) + 0.5) * cell_m;
                const double layers = floor_m(at_x, at_y) / cell_m - static_cast<double>(range_.low[2]);
                for (int z = 0; z < size_.nz && z + 0.5 < layers; ++z)
                    if (Cell& cell = cells_[size_.index(x, y, z)]; cell == Cell::unknown) cell = Cell::closed;
            }
    }

    void flood()
    {
        std::vector<std::size_t> open;
        const auto enter = [&](int x, int y, int z)
        {
            const std::size_t i = size_.index(x, y, z);
            if (cells_[i] != Cell::unknown) return;
            cells_[i] = Cell::outside;
            open.push_back(i);
        };
        for (int z = 0; z < size_.nz; ++z)
            for (int y = 0; y < size_.ny; ++y)
            {
                const bool face = z == 0 || z == size_.nz - 1 || y == 0 || y == size_.ny - 1;
                for (int x = 0; x < size_.nx; x += face || size_.nx == 1 ? 1 : size_.nx - 1) enter(x, y, z);
            }
        const auto nx = static_cast<std::size_t>(size_.nx), ny = static_cast<std::size_t>(size_.ny);
        while (!open.empty())
        {
            const std::size_t i = open.back();
            open.pop_back();
            const int x = static_cast<int>(i % nx), y = static_cast<int>(i / nx % ny),
                      z = static_cast<int>(i / nx / ny);
            if (x > 0) enter(x - 1, y, z);
            if (x + 1 < size_.nx) enter(x + 1, y, z);
            if (y > 0) enter(x, y - 1, z);
            if (y + 1 < size_.ny) enter(x, y + 1, z);
            if (z > 0) enter(x, y, z - 1);
            if (z + 1 < size_.nz) enter(x, y, z + 1);
        }
    }

    Range range_;
    GridSize size_;
    std::vector<Cell> cells_;
};

Range range_of(const Mesh& mesh, double cell_m)
{
    Vec3d low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    for (const Vertex& v : mesh.vertices)
    {
        const Vec3d p{v.position_m.x / cell_m, v.position_m.y / cell_m, v.position_m.z / cell_m};
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    const auto below = [](double v)
    { return static_cast<std::int64_t>(std::clamp(std::floor(v), -1e9, 1e9)) - 1; };
    const auto above = [](double v)
    { return static_cast<std::int64_t>(std::clamp(std::floor(v), -1e9, 1e9)) + 2; };
    return {{below(low.x), below(low.y), below(low.z)}, {above(high.x), above(high.y), above(high.z)}};
}

}  // namespace

Voxeliser::Voxeliser(Vec3f size_m, double cell_m, Height floor_m)
    : cell_m_(cell_m), floor_m_(std::move(floor_m))
{
    const auto cells = [&](float length)
    { return std::max(1.0, std::ceil(static_cast<double>(length) / cell_m - 1e-6)); };
    const double nx = cells(size_m.x), ny = cells(size_m.y), nz = cells(size_m.z);
    if (const double count = nx * ny * nz; !(count <= static_cast<double>(kMostVoxels)))
        throw Error(
            fmt::format("voxels.size_m = {:g} would need {:.3g} voxels ({:.0f} x {:.0f} x {:.0f}, {:.1f} "
                        "GiB); at most {} "
                        "are allowed: use larger voxels or a smaller domain",
                        cell_m, count, nx, ny, nz, count * 2 / 1073741824.0, kMostVoxels));
    size_ = {static_cast<int>(nx), static_cast<int>(ny), static_cast<int>(nz)};
    grid_.nx = size_.nx;
    grid_.ny = size_.ny;
    grid_.nz = size_.nz;
    grid_.cell_m = static_cast<float>(cell_m);
    grid_.clearance.assign(size_.count(), 255);
    grid_.surface.assign(size_.count(), 0);
}

Vec3d Voxeliser::centre(int x, int y, int z) const
{
    return {(x + 0.5) * cell_m_, (y + 0.5) * cell_m_, (z + 0.5) * cell_m_};
}

void Voxeliser::fill(int x, int y, int z, std::uint8_t surface)
{
    const std::size_t i = size_.index(x, y, z);
    grid_.clearance[i] = 0;
    grid_.surface[i] = surface;
    anything_ = true;
}

void Voxeliser::add_mesh(const Mesh& mesh, std::uint8_t surface)
{
    if (mesh.vertices.empty()) return;
    Range range = range_of(mesh, cell_m_);
    // A model that reaches far out of the domain is cut off at its border; the cut then counts as open.
    const std::array<std::int64_t, 3> n{size_.nx, size_.ny, size_.nz};
    if (range.count() > 4.0 * static_cast<double>(size_.count()) + (1 << 22))
        for (int a = 0; a < 3; ++a)
        {
            range.low[a] = std::max<std::int64_t>(range.low[a], -1);
            range.high[a] = std::min<std::int64_t>(range.high[a], n[a] + 1);
            if (range.low[a] >= range.high[a]) return;
        }
    MeshFill(mesh, range, cell_m_, floor_m_)
        .each_solid(
            [&](std::int64_t x, std::int64_t y, std::int64_t z)
            {
                if (x >= 0 && x < n[0] && y >= 0 && y < n[1] && z >= 0 && z < n[2])
                    fill(static_cast<int>(x), static_cast<int>(y), static_cast<int>(z), surface);
            });
}

void Voxeliser::add_box(Vec3d min_m, Vec3d max_m, std::uint8_t surface)
{
    struct Span
    {
        int low, high;
    };
    const auto span = [&](double low_m, double high_m, int n) -> Span
    {
        const double low = std::round(low_m / cell_m_), high = std::round(high_m / cell_m_);
        const double middle = std::floor(0.5 * (low_m + high_m) / cell_m_);
        const double from = high > low ? low : middle, to = high > low ? high : middle + 1;
        const auto limit = [&](double v)
        { return static_cast<int>(std::clamp(v, 0.0, static_cast<double>(n))); };
        return {limit(from), limit(to)};
    };
    const Span sx = span(min_m.x, max_m.x, size_.nx), sy = span(min_m.y, max_m.y, size_.ny),
               sz = span(min_m.z, max_m.z, size_.nz);
    for (int z = sz.low; z < sz.high; ++z)
        for (int y = sy.low; y < sy.high; ++y)
            for (int x = sx.low; x < sx.high; ++x) fill(x, y, z, surface);
}

void Voxeliser::add_height_field(const Height& height_m, std::uint8_t surface)
{
    for (int y = 0; y < size_.ny; ++y)
        for (int x = 0; x < size_.nx; ++x)
        {
            const double height = height_m((x + 0.5) * cell_m_, (y + 0.5) * cell_m_);
            for (int z = 0; z < size_.nz && (z + 0.5) * cell_m_ < height; ++z) fill(x, y, z, surface);
        }
}

void Voxeliser::add_where(const std::function<bool(Vec3d)>& inside, std::uint8_t surface)
{
    for (int z = 0; z < size_.nz; ++z)
        for (int y = 0; y < size_.ny; ++y)
            for (int x = 0; x < size_.nx; ++x)
                if (inside(centre(x, y, z))) fill(x, y, z, surface);
}

VoxelGrid Voxeliser::finish()
{
    if (!anything_) return {};
    chebyshev_distance(size_, grid_.clearance);
    return std::move(grid_);
}

}  // namespace spindrift::scene
