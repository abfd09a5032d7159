// SPDX-License-Identifier: MIT
#include "scene/quic_files.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <string>
#include <string_view>

#include "core/error.h"

namespace spindrift::scene
{

namespace
{

constexpr double kSecondsPerHour = 3600;
constexpr double kKolmogorov = 5.7;  ///< C0 of the models that wrote these files

/// A text file of numbers, read from its beginning. Every failure names the file and the line.
class NumberText
{
  public:
    explicit NumberText(const std::filesystem::path& file) : name_(file.string())
    {
        std::error_code failed;
        if (!std::filesystem::exists(file, failed)) throw Error(fmt::format("{}: no such wind file", name_));
        if (!std::filesystem::is_regular_file(file, failed))
            throw Error(fmt::format("{} is not a plain file; name a text file of QUIC", name_));
        std::ifstream in(file, std::ios::binary);
        text_.assign(std::istreambuf_iterator<char>(in), {});
        if (!in) throw Error(fmt::format("{} cannot be read", name_));
    }

    [[noreturn]] void fail(const std::string& what) const
    {
        throw Error(fmt::format("{}:{}: {}", name_, line_, what));
    }

    const std::string& name() const { return name_; }

    /// Skips blank lines; empty at the end of the file.
    std::string_view peek_line()
    {
        while (at_ < text_.size() && is_space(text_[at_])) skip_one();
        const std::size_t end = std::min(text_.find('\n', at_), text_.size());
        return std::string_view(text_).substr(at_, end - at_);
    }

    std::string_view take_line()
    {
        const std::string_view line = peek_line();
        at_ += line.size();
        return line;
    }

    /// The numbers at the start of the next line; what follows them there is a comment.
    template <std::size_t N>
    std::array<double, N> row(const char* what)
    {
        const std::string_view line = take_line();
        const char* from = line.data();
        const char* const end = from + line.size();
        std::array<double, N> numbers{};
        for (double& number : numbers)
        {
            while (from != end && (is_space(*from) || *from == '+')) ++from;
            const auto [next, status] = std::from_chars(from, end, number);
            if (status != std::errc() || !(std::abs(number) < 1e6))
                fail(fmt::format("'{}' is no line of {} finite numbers ({})", line.substr(0, 60), N, what));
            from = next;
        }
        return numbers;
    }

  private:
    static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
    void skip_one()
    {
        if (text_[at_] == '\n') ++line_;
        ++at_;
    }

    std::string name_, text_;
    std::size_t at_ = 0, line_ = 1;
};

/// The cells of a file, found from their centres: x fastest, all equally large.
class CellWalk
{
  public:
    /// Of rows whose first three numbers are a cell's centre. Throws if they are no regular grid.
    template <class Row>
    CellWalk(const NumberText& text, const std::vector<Row>& rows)
    {
        if (rows.size() < 8) text.fail("the file ends after fewer than eight cells; it may be cut off");
        while (nx_ < rows.size() && (nx_ == 0 || rows[nx_][0] > rows[nx_ - 1][0])) ++nx_;
        while (nx_ * ny_ < rows.size() && (ny_ == 0 || rows[nx_ * ny_][1] > rows[nx_ * (ny_ - 1)][1])) ++ny_;
        nz_ = rows.size() / (nx_ * ny_);
        if (nx_ < 2 || ny_ < 2 || nz_ < 2 || nx_ * ny_ * nz_ != rows.size())
            text.fail(
                fmt::format("{} cells are no whole grid of {} x {} cells a layer; the file may be cut off",
                            rows.size(), nx_, ny_));
        if (static_cast<double>(rows.size()) > kMostFileCells)
            text.fail(fmt::format("{} cells are more than the {:.0f} allowed", rows.size(), kMostFileCells));
        first_ = {rows[0][0], rows[0][1], rows[0][2]};
        step_ = {rows[1][0] - first_.x, rows[nx_][1] - first_.y, rows[nx_ * ny_][2] - first_.z};
        if (!(step_.x > 1e-4 && step_.y > 1e-4 && step_.z > 1e-4))
            text.fail("the centres of the cells do not rise along x, y and z");
        check(text, rows);
    }

    /// Throws if the rows do not lie on this grid.
    template <class Row>
    void check(const NumberText& text, const std::vector<Row>& rows, std::size_t first_layer = 0) const
    {
        const std::size_t layer = nx_ * ny_;
        if (rows.size() != layer * (nz_ - first_layer))
            text.fail(fmt::format("{} cells, not the {} x {} x {} of the velocities", rows.size(), nx_, ny_,
                                  nz_ - first_layer));
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            const auto near = [](double at, double first, double step, std::size_t n)
            { return std::abs(at - (first + static_cast<double>(n) * step)) < 0.02 * step; };
            if (!near(rows[i][0], first_.x, step_.x, i % nx_) ||
                !near(rows[i][1], first_.y, step_.y, i / nx_ % ny_) ||
                !near(rows[i][2], first_.z, step_.z, i / layer + first_layer))
                text.fail(
                    fmt::format("cell {} at ({:g}, {:g}, {:g}) is not where a grid of {:g} x {:g} x {:g} m "
                                "cells has it; layers of unequal height are not read",
                                i + 1, rows[i][0], rows[i][1], rows[i][2], step_.x, step_.y, step_.z));
        }
    }

    /// Without the layer under the ground.
    GridSize air() const { return {static_cast<int>(nx_), static_cast<int>(ny_), static_cast<int>(nz_) - 1}; }
    std::size_t layer() const { return nx_ * ny_; }
    Vec3d cell_m() const { return step_; }
    bool has_ground_layer() const { return first_.z < 0; }

  private:
    std::size_t nx_ = 0, ny_ = 0, nz_ = 0;
    Vec3d first_{}, step_{};
};

using VelocityRow = std::array<double, 6>;  ///< x y z u v w
using KindRow = std::array<double, 4>;      ///< x y z kind
using StressRow = std::array<double, 12>;   ///< x y z SIGU SIGV SIGW LZ LEFF EPS UV UW VW

template <class Row>
std::vector<Row> read_rows(NumberText& text, const char* what)
{
    std::vector<Row> rows;
    for (std::string_view line = text.peek_line(); !line.empty() && line[0] != '%'; line = text.peek_line())
        rows.push_back(text.row<std::tuple_size_v<Row>>(what));
    return rows;
}

/// Faces between two cells of air get the mean of their velocities, faces at the border the cell's own,
/// faces of solid cells nothing.
StaggeredWind on_faces(const CellWalk& walk, const std::vector<VelocityRow>& rows,
                       const std::vector<std::uint8_t>& solid)
{
    StaggeredWind wind(walk.air(), walk.cell_m());
    wind.solid = solid;
    const GridSize n = wind.size;
    const auto fill = [&](GridSize faces, std::vector<double>& out, int dx, int dy, int dz, std::size_t part)
    {
        for (int z = 0; z < faces.nz; ++z)
            for (int y = 0; y < faces.ny; ++y)
                for (int x = 0; x < faces.nx; ++x)
                {
                    double sum = 0;
                    int cells = 0;
                    bool closed = dz == 1 && z == 0;  // the ground
                    for (int side = 0; side < 2; ++side)
                    {
                        const int cx = x - side * dx, cy = y - side * dy, cz = z - side * dz;
                        if (cx < 0 || cy < 0 || cz < 0 || cx >= n.nx || cy >= n.ny || cz >= n.nz) continue;
                        const std::size_t i = n.index(cx, cy, cz);
                        closed = closed || solid[i] != 0;
                        sum += rows[walk.layer() + i][part];
                        ++cells;
                    }
                    out[faces.index(x, y, z)] = closed ? 0 : sum / cells;
                }
    };
    fill(wind.u_size(), wind.u, 1, 0, 0, 3);
    fill(wind.v_size(), wind.v, 0, 1, 0, 4);
    fill(wind.w_size(), wind.w, 0, 0, 1, 5);
    return wind;
}

std::vector<std::uint8_t> read_solids(const std::filesystem::path& file, const CellWalk& walk)
{
    NumberText text(file);
    const auto rows = read_rows<KindRow>(text, "x, y, z and the kind of a cell");
    walk.check(text, rows);
    std::vector<std::uint8_t> solid;
    for (std::size_t i = walk.layer(); i < rows.size(); ++i)
        solid.push_back(std::lround(rows[i][3]) == 0 ? 1 : 0);
    return solid;
}

/// The three sigmas lie along, across and above the local wind; horizontal air is assumed, as in those
/// models.
Stress<float> stress_of(const StressRow& row, const VelocityRow& wind)
{
    const double speed = std::hypot(wind[3], wind[4]);
    const double c = speed > 0 ? wind[3] / speed : 1, s = speed > 0 ? wind[4] / speed : 0;
    const double along = row[3] * row[3], across = row[4] * row[4];
    const auto f = [](double v) { return static_cast<float>(v); };
    return {f(c * c * along + s * s * across), f(row[9]),  f(row[10]),
            f(s * s * along + c * c * across), f(row[11]), f(row[5] * row[5])};
}

void read_turbulence(const std::filesystem::path& file, const CellWalk& walk,
                     const std::vector<std::vector<VelocityRow>>& velocity, std::vector<WindSlice>& slices)
{
    NumberText text(file);
    for (const std::string_view start : {"TITLE", "VARIABLES", "ZONE", "I=", "DT="})
        if (!text.take_line().starts_with(start))
            text.fail(fmt::format("a line that starts with {} is missing; name a QP_turbfield.dat", start));
    const auto rows = read_rows<StressRow>(text, "x, y, z and nine numbers of turbulence");
    walk.check(text, rows, 1);
    for (std::size_t t = 0; t < slices.size(); ++t)
        for (std::size_t i = 0; i < rows.size(); ++i)
        {
            slices[t].stress.push_back(stress_of(rows[i], velocity[t][walk.layer() + i]));
            slices[t].c0_eps.push_back(static_cast<float>(std::max(kKolmogorov * rows[i][8], 0.0)));
        }
}

/// The file's time steps: their times in seconds after the first, and their rows.
struct Velocities
{
    std::vector<double> time_s;
    std::vector<std::vector<VelocityRow>> rows;
};

Velocities read_velocities(NumberText& text)
{
    if (!text.take_line().starts_with('%'))
        text.fail("the first line must start with %; name a QU_velocity.dat");
    const double count = text.row<1>("number of time steps")[0];
    if (!(count >= 1 && count <= 10000 && count == std::floor(count)))
        text.fail(fmt::format("{:g} time steps; 1 to 10000 are allowed", count));
    Velocities found;
    for (int step = 0; step < static_cast<int>(count); ++step)
    {
        if (!text.take_line().starts_with('%'))
            text.fail(
                fmt::format("time step {} of {:g} is missing; the file may be cut off", step + 1, count));
        text.row<1>("number of the time step");
        found.time_s.push_back(text.row<1>("time in hours")[0] * kSecondsPerHour);
        if (step > 0 && !(found.time_s[step] > found.time_s[step - 1]))
            text.fail("its time is not later than that of the time step before it");
        found.rows.push_back(read_rows<VelocityRow>(text, "x, y, z, u, v and w of a cell"));
    }
    if (!text.peek_line().empty()) text.fail("more time steps than the second line says");
    return found;
}

}  // namespace

std::vector<WindSlice> read_quic_files(const std::filesystem::path& velocity,
                                       const std::filesystem::path& turbulence)
{
    NumberText text(velocity);
    const Velocities found = read_velocities(text);
    const CellWalk walk(text, found.rows[0]);
    if (!walk.has_ground_layer()) text.fail("the first layer of cells must lie under the ground (z below 0)");
    const std::vector<std::uint8_t> solid = read_solids(velocity.parent_path() / "QU_celltype.dat", walk);
    std::vector<WindSlice> slices;
    for (std::size_t t = 0; t < found.rows.size(); ++t)
    {
        walk.check(text, found.rows[t]);
        WindSlice slice;
        slice.time_s = found.time_s[t] - found.time_s[0];
        slice.wind = on_faces(walk, found.rows[t], solid);
        slices.push_back(std::move(slice));
    }
    if (!turbulence.empty()) read_turbulence(turbulence, walk, found.rows, slices);
    return slices;
}

}  // namespace spindrift::scene
