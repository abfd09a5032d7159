// SPDX-License-Identifier: MIT
#include "gl/cluster_lamps.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace spindrift::gl
{

namespace
{

constexpr int kColumns = ClusterGrid::kColumns, kRows = ClusterGrid::kRows, kSlices = ClusterGrid::kSlices;
constexpr double kFirstDepth_m = 2;  // where slice 0 ends, at most
/// Of a column, row or slice: what rounding of a flake's place may be off by, in single precision and in a
/// shader's log2.
constexpr double kMargin = 0.01;

bool bounded(const Lamp<float>& lamp)
{
    return lamp.kind != LampKind::directional && std::isfinite(lamp.range_m);
}

/// All that a lamp reaches lies in it. Relative to the eye: right, up, forward.
struct Ball
{
    Vec3d centre;
    double radius_m;
};

Ball ball_of(const Lamp<float>& lamp, const View& view)
{
    const auto wide = [](const Vec3f& v) { return Vec3d{v.x, v.y, v.z}; };
    const double range_m = lamp.range_m;
    Ball ball{wide(lamp.position_m), range_m};
    if (lamp.kind == LampKind::spot)
    {
        // Round a cone that ends in a cap: through its tip and rim, or round the rim if it is wide.
        const double cosine = std::max<double>(lamp.cos_outer, 0);
        const bool narrow = cosine > std::sqrt(0.5);
        const double ahead_m = narrow ? range_m / (2 * cosine) : range_m * cosine;
        ball.centre = ball.centre + wide(lamp.direction) * ahead_m;
        ball.radius_m = narrow ? ahead_m : range_m * std::sqrt(1 - cosine * cosine);
    }
    const Vec3d away = ball.centre - wide(view.eye);
    ball.centre = {dot(away, wide(view.right)), dot(away, wide(view.up)), dot(away, wide(view.forward))};
    ball.radius_m *= 1.0001;
    return ball;
}

/// First and last of a row of cells, none if first > last.
struct Cells
{
    int first, last;
};

/// Slices, columns and rows of a view, in double.
class Space
{
  public:
    Space(const View& view, double farthest_m)
        : focal_px_(view.height_px / (2.0 * view.tan_half_fov_y)),
          width_px_(view.width_px),
          height_px_(view.height_px),
          guard_px_(view.guard_px),
          per_log2_((kSlices - 2) / std::max(std::log2(farthest_m / kFirstDepth_m), 1.0))
    {
    }

    ClusterGrid grid() const
    {
        ClusterGrid grid;
        grid.left_px = grid.bottom_px = static_cast<float>(-guard_px_);
        grid.columns_per_px = static_cast<float>(kColumns / across_px());
        grid.rows_per_px = static_cast<float>(kRows / down_px());
        grid.first_log2 = static_cast<float>(std::log2(kFirstDepth_m));
        grid.slices_per_log2 = static_cast<float>(per_log2_);
        return grid;
    }

    double slice_begins_m(int slice) const
    {
        if (slice == 0) return 0;
        return kFirstDepth_m * std::exp2((slice - 1 - kMargin) / per_log2_);
    }
    double slice_ends_m(int slice) const
    {
        if (slice == kSlices - 1) return std::numeric_limits<double>::infinity();
        return kFirstDepth_m * std::exp2((slice + kMargin) / per_log2_);
    }

    /// Columns or rows (`down`) that the interval [low, high] m across covers at depths [near, far] m.
    Cells cells(double low, double high, double near_m, double far_m, bool down) const
    {
        const double size_px = down ? height_px_ : width_px_;
        const double per_px = down ? kRows / down_px() : kColumns / across_px();
        const int count = down ? kRows : kColumns;
        const auto cell = [&](double across, double depth_m)
        {
            if (depth_m <= 0)
                return across < 0 ? -std::numeric_limits<double>::infinity()
                                  : std::numeric_limits<double>::infinity();
            return (0.5 * size_px + across / depth_m * focal_px_ + guard_px_) * per_px;
        };
        const auto inside = [&](double at) { return std::clamp(std::floor(at), 0.0, count - 1.0); };
        return {static_cast<int>(inside(cell(low, low < 0 ? near_m : far_m) - kMargin)),
                static_cast<int>(inside(cell(high, high < 0 ? far_m : near_m) + kMargin))};
    }

    /// Unit way through a place of the grid, in columns and rows.
    Vec3d way(double column, double row) const
    {
        const double x_px = column / kColumns * across_px() - guard_px_ - 0.5 * width_px_;
        const double y_px = row / kRows * down_px() - guard_px_ - 0.5 * height_px_;
        const Vec3d way{x_px / focal_px_, y_px / focal_px_, 1};
        return way * (1 / std::sqrt(dot(way, way)));
    }

  private:
    double across_px() const { return width_px_ + 2 * guard_px_; }
    double down_px() const { return height_px_ + 2 * guard_px_; }

    double focal_px_, width_px_, height_px_, guard_px_, per_log2_;
};

/// Calls body(column, row, slice) for the clusters that a ball reaches into.
template <class Body>
void each_lit(const Space& space, const Ball& ball, const Body& body)
{
    const Vec3d& c = ball.centre;
    for (int slice = 0; slice < kSlices; ++slice)
    {
        const double near_m = std::max(space.slice_begins_m(slice), c.z - ball.radius_m);
        const double far_m = std::min(space.slice_ends_m(slice), c.z + ball.radius_m);
        if (near_m > far_m) continue;
        // The widest cut between the slice's two ends.
        const double off_m = std::clamp(c.z, near_m, far_m) - c.z;
        const double reach_m = std::sqrt(std::max(ball.radius_m * ball.radius_m - off_m * off_m, 0.0));
        const Cells columns = space.cells(c.x - reach_m, c.x + reach_m, near_m, far_m, false);
        const Cells rows = space.cells(c.y - reach_m, c.y + reach_m, near_m, far_m, true);
        for (int row = rows.first; row <= rows.last; ++row)
            for (int column = columns.first; column <= columns.last; ++column) body(column, row, slice);
    }
}

/// The ways from the eye through one column and row lie in this cone; the outermost ones hold all that is
/// farther out, too.
struct WayCone
{
    Vec3d axis;
    double cosine, sine;  // of its half angle
};

WayCone way_cone(const Space& space, int column, int row)
{
    WayCone cone{space.way(column + 0.5, row + 0.5), 1, 0};
    for (const double right : {-kMargin, 1 + kMargin})
        for (const double up : {-kMargin, 1 + kMargin})
            cone.cosine = std::min(cone.cosine, dot(cone.axis, space.way(column + right, row + up)));
    cone.sine = std::sqrt(1 - cone.cosine * cone.cosine);
    return cone;
}

/// Whether a ball touches a cone that begins in the origin: the angle between its centre and the axis is at
/// most the cone's half angle and the angle under which the ball is seen.
bool touches(const WayCone& cone, const Ball& ball)
{
    const double away2 = dot(ball.centre, ball.centre);
    if (away2 <= ball.radius_m * ball.radius_m) return true;
    const double away_m = std::sqrt(away2);
    const double sine = ball.radius_m / away_m, cosine = std::sqrt(1 - sine * sine);
    const double both_cosine = cone.cosine * cosine - cone.sine * sine;
    const bool half_turn = cone.sine * cosine + cone.cosine * sine < 0;
    return half_turn || dot(cone.axis, ball.centre) >= both_cosine * away_m;
}

template <class Body>
void each_on_the_way(const Space& space, const std::vector<WayCone>& cones, const Ball& ball,
                     const Body& body)
{
    const double begins_m = ball.centre.z - ball.radius_m;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column)
        {
            if (!touches(cones[static_cast<std::size_t>(row * kColumns + column)], ball)) continue;
            for (int slice = 0; slice < kSlices; ++slice)
                if (begins_m <= space.slice_ends_m(slice)) body(column, row, slice);
        }
}

}  // namespace

std::size_t count_bounded(std::span<const Lamp<float>> lamps)
{
    return static_cast<std::size_t>(std::count_if(lamps.begin(), lamps.end(), bounded));
}

std::vector<std::uint32_t> pack(const LampClusters& clusters)
{
    const ClusterGrid& grid = clusters.grid;
    const std::size_t bits = ClusterGrid::count() * clusters.words;
    std::vector<std::uint32_t> packed;
    for (const float value : {grid.left_px, grid.bottom_px, grid.columns_per_px, grid.rows_per_px,
                              grid.first_log2, grid.slices_per_log2})
        packed.push_back(std::bit_cast<std::uint32_t>(value));
    packed.push_back(static_cast<std::uint32_t>(clusters.words));
    packed.push_back(static_cast<std::uint32_t>(bits));
    packed.insert(packed.end(), clusters.lit, clusters.lit + bits);
    packed.insert(packed.end(), clusters.on_the_way, clusters.on_the_way + bits);
    return packed;
}

ClusteredLamps::ClusteredLamps(std::span<const Lamp<float>> lamps, const View& view)
    : words_((lamps.size() + 31) / 32),
      lit_(ClusterGrid::count() * words_),
      on_the_way_(ClusterGrid::count() * words_)
{
    double farthest_m = kFirstDepth_m;
    for (const Lamp<float>& lamp : lamps)
        if (bounded(lamp))
        {
            const Ball ball = ball_of(lamp, view);
            farthest_m = std::max(farthest_m, ball.centre.z + ball.radius_m);
        }
    const Space space(view, std::min<double>(farthest_m, view.far_m));
    grid_ = space.grid();
    std::vector<WayCone> cones;
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) cones.push_back(way_cone(space, column, row));

    for (std::size_t i = 0; i < lamps.size(); ++i)
    {
        const std::uint32_t bit = 1U << i % 32;
        const auto mark = [&](std::vector<std::uint32_t>& bits)
        {
            return [&bits, bit, word = i / 32, words = words_](int column, int row, int slice)
            {
                const int at = (slice * kRows + row) * kColumns + column;
                bits[static_cast<std::size_t>(at) * words + word] |= bit;
            };
        };
        if (!bounded(lamps[i]))
        {
            for (std::size_t at = i / 32; at < lit_.size(); at += words_)
            {
                lit_[at] |= bit;
                on_the_way_[at] |= bit;
            }
            continue;
        }
        const Ball ball = ball_of(lamps[i], view);
        each_lit(space, ball, mark(lit_));
        each_on_the_way(space, cones, ball, mark(on_the_way_));
    }
}

}  // namespace spindrift::gl
