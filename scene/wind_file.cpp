// SPDX-License-Identifier: MIT
#include "scene/wind_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "scene/netcdf_file.h"
#include "scene/quic_files.h"
#include "scene/try_in_child.h"

namespace spindrift::scene
{

namespace
{

/// One horizontal layer set of the file without its ghost layer.
struct Layers
{
    std::vector<double> thickness_m;  ///< bottom to top
    double total_m = 0;

    bool even() const
    {
        return std::all_of(thickness_m.begin(), thickness_m.end(),
                           [&](double d) { return std::abs(d - thickness_m[0]) <= 1e-3 * thickness_m[0]; });
    }
};

double spacing(const NetcdfFile& file, const char* axis)
{
    const std::vector<std::size_t> shape = file.shape(axis);
    if (shape.size() != 1 || shape[0] == 0)
        throw Error(fmt::format("{}: '{}' is not a list of cell centres", file.name(), axis));
    const std::vector<float> centre = file.read(axis, shape);
    const double step = centre.size() > 1 ? static_cast<double>(centre[1]) - centre[0] : 2.0 * centre[0];
    if (!(step > 1e-4))
        throw Error(
            fmt::format("{}: the cells along {} are {} m wide; they must rise", file.name(), axis, step));
    for (std::size_t i = 1; i < centre.size(); ++i)
        if (std::abs(static_cast<double>(centre[i]) - centre[i - 1] - step) > 1e-2 * step)
            throw Error(
                fmt::format("{}: cells along {} are not equally wide (cell {})", file.name(), axis, i));
    return step;
}

Layers read_layers(const NetcdfFile& file, std::size_t cells_z)
{
    Layers layers;
    if (file.has("dz_array"))
    {
        const std::vector<float> dz = file.read("dz_array", {cells_z});
        layers.thickness_m.assign(dz.begin() + 1, dz.end());
    }
    else
    {
        const std::vector<float> z =
            file.read("z", {cells_z});  // centres: half the first layer above the ground
        double below = 0;
        for (std::size_t k = 1; k < cells_z; ++k)
        {
            layers.thickness_m.push_back(2 * (static_cast<double>(z[k]) - below));
            below += layers.thickness_m.back();
        }
    }
    for (const double d : layers.thickness_m)
    {
        if (!(d > 1e-4))
            throw Error(
                fmt::format("{}: a layer of cells is {} m thick; it must be above 0", file.name(), d));
        layers.total_m += d;
    }
    return layers;
}

/// Where even layers lie among those of the file: for every height the two entries to mix.
class LayerMap
{
  public:
    /// `at`: heights of the file's entries, ascending.
    LayerMap(std::vector<double> at, const std::vector<double>& wanted) : size_(at.size())
    {
        for (const double height : wanted)
        {
            const auto above = std::upper_bound(at.begin(), at.end(), height);
            const auto high = static_cast<std::size_t>(
                std::clamp<std::ptrdiff_t>(above - at.begin(), 1, std::ssize(at) - 1));
            const std::size_t low = at.size() > 1 ? high - 1 : 0;
            const double span = at.size() > 1 ? at[high] - at[low] : 1;
            low_.push_back(low);
            share_.push_back(at.size() > 1 ? std::clamp((height - at[low]) / span, 0.0, 1.0) : 0.0);
        }
    }

    std::size_t count() const { return low_.size(); }
    double mix(std::size_t k, double low, double high) const { return low + share_[k] * (high - low); }
    std::size_t low(std::size_t k) const { return low_[k]; }
    std::size_t high(std::size_t k) const { return std::min(low_[k] + 1, size_ - 1); }
    std::size_t nearest(std::size_t k) const { return share_[k] < 0.5 ? low(k) : high(k); }

  private:
    std::size_t size_;
    std::vector<std::size_t> low_;
    std::vector<double> share_;
};

/// Shape of the file's arrays and the grid that comes out.
struct Frame
{
    std::size_t nx, ny, cells_z;  ///< cells; cells_z with the ghost layer
    GridSize out;
    Vec3d cell_m;
    std::vector<double> centres, faces;          ///< heights in the file, without the ghost layer
    std::vector<double> out_centres, out_faces;  ///< heights in the result

    std::vector<std::size_t> face_shape() const { return {cells_z + 1, ny + 1, nx + 1}; }
    std::vector<std::size_t> cell_shape() const { return {cells_z, ny, nx}; }
};

Frame read_frame(const NetcdfFile& file)
{
    if (file.has("icell") && !file.has("icellflag"))
        throw Error(fmt::format(
            "{} is the cell-centred picture file of QES-Winds (windsOut); name the *_windsWk.nc beside it",
            file.name()));
    const std::vector<std::size_t> shape = file.shape("u");
    if (shape.size() != 3 || shape[0] < 3 || shape[1] < 2 || shape[2] < 2)
        throw Error(fmt::format(
            "{}: 'u' must have the dimensions t, z_face, y_face, x_face with a layer above the ghost layer",
            file.name()));
    Frame frame{shape[2] - 1, shape[1] - 1, shape[0] - 1, {}, {}, {}, {}, {}, {}};
    const Layers layers = read_layers(file, frame.cells_z);
    const double dz = layers.even() ? layers.total_m / static_cast<double>(layers.thickness_m.size())
                                    : *std::min_element(layers.thickness_m.begin(), layers.thickness_m.end());
    const double nz = layers.even() ? static_cast<double>(layers.thickness_m.size())
                                    : std::ceil(layers.total_m / dz - 1e-6);
    if (const double cells = nz * static_cast<double>(frame.nx) * static_cast<double>(frame.ny);
        !(cells <= kMostFileCells))
        throw Error(fmt::format("{} would give {:.3g} wind cells ({:.1f} GB); at most {:.0f} are allowed",
                                file.name(), cells, cells * 64e-9, kMostFileCells));
    frame.out = {static_cast<int>(frame.nx), static_cast<int>(frame.ny), static_cast<int>(nz)};
    frame.cell_m = {spacing(file, "x"), spacing(file, "y"), dz};
    double height = 0;
    for (const double d : layers.thickness_m)
    {
        frame.faces.push_back(height);
        frame.centres.push_back(height + 0.5 * d);
        height += d;
    }
    frame.faces.push_back(height);
    for (int k = 0; k < frame.out.nz; ++k)
    {
        frame.out_faces.push_back(k * dz);
        frame.out_centres.push_back((k + 0.5) * dz);
    }
    frame.out_faces.push_back(frame.out.nz * dz);
    return frame;
}

/// Brings an array of the file to even layers: `put(i, value)` for the first nx of `stride_x` columns and ny
/// of `stride_y` rows.
template <class Put>
void each_mixed(const std::vector<float>& from, std::size_t stride_x, std::size_t stride_y, std::size_t nx,
                std::size_t ny, const LayerMap& map, Put put)
{
    std::size_t i = 0;
    for (std::size_t k = 0; k < map.count(); ++k)
        for (std::size_t y = 0; y < ny; ++y)
            for (std::size_t x = 0; x < nx; ++x)
            {
                const auto at = [&](std::size_t layer)  // + 1: the ghost layer
                { return static_cast<double>(from[((layer + 1) * stride_y + y) * stride_x + x]); };
                put(i++, map.mix(k, at(map.low(k)), at(map.high(k))));
            }
}

StaggeredWind read_winds(const NetcdfFile& file, const Frame& frame, std::size_t slice)
{
    StaggeredWind wind(frame.out, frame.cell_m);
    const LayerMap centres(frame.centres, frame.out_centres), faces(frame.faces, frame.out_faces);
    const std::size_t nx = frame.nx, ny = frame.ny;
    each_mixed(file.read("u", frame.face_shape(), slice), nx + 1, ny + 1, nx + 1, ny, centres,
               [&](std::size_t i, double v) { wind.u[i] = v; });
    each_mixed(file.read("v", frame.face_shape(), slice), nx + 1, ny + 1, nx, ny + 1, centres,
               [&](std::size_t i, double v) { wind.v[i] = v; });
    each_mixed(file.read("w", frame.face_shape(), slice), nx + 1, ny + 1, nx, ny, faces,
               [&](std::size_t i, double v) { wind.w[i] = v; });
    const std::vector<float> flags =
        file.read("icellflag", frame.cell_shape(), std::min(slice, file.slices("icellflag") - 1));
    std::size_t i = 0;
    for (std::size_t k = 0; k < centres.count(); ++k)
        for (std::size_t column = 0; column < nx * ny; ++column, ++i)
        {
            const int flag = static_cast<int>(flags[(centres.nearest(k) + 1) * nx * ny + column]);
            wind.solid[i] = flag == 0 || flag == 2 ? 1 : 0;  // building or terrain
        }
    return wind;
}

/// A turbulence file of one slice holds for all times.
void read_turbulence(const NetcdfFile& file, const Frame& frame, std::size_t slice, WindSlice& out)
{
    const LayerMap centres(frame.centres, frame.out_centres);
    out.stress.assign(frame.out.count(), {});
    out.c0_eps.assign(frame.out.count(), 0);
    const auto read = [&](const char* name, auto put)
    {
        each_mixed(file.read(name, frame.cell_shape(), std::min(slice, file.slices(name) - 1)), frame.nx,
                   frame.ny, frame.nx, frame.ny, centres,
                   [&](std::size_t i, double v) { put(i, static_cast<float>(v)); });
    };
    read("txx", [&](std::size_t i, float v) { out.stress[i].xx = v; });
    read("txy", [&](std::size_t i, float v) { out.stress[i].xy = v; });
    read("txz", [&](std::size_t i, float v) { out.stress[i].xz = v; });
    read("tyy", [&](std::size_t i, float v) { out.stress[i].yy = v; });
    read("tyz", [&](std::size_t i, float v) { out.stress[i].yz = v; });
    read("tzz", [&](std::size_t i, float v) { out.stress[i].zz = v; });
    read("CoEps", [&](std::size_t i, float v) { out.c0_eps[i] = std::max(v, 0.0F); });
}

/// Reading takes seconds at most; a broken file may send HDF5 round in circles.
constexpr unsigned kLongestRead_s = 300;

/// Times of the file's slices, from 0.
std::vector<double> read_times(const NetcdfFile& file)
{
    const std::size_t count = file.slices("u");
    if (count == 1) return {0};
    std::vector<double> times = file.read_times("t", count);
    const double first = times[0];
    for (double& time : times) time -= first;
    return times;
}

std::vector<WindSlice> read_both(const std::filesystem::path& winds, const std::filesystem::path& turbulence)
{
    const NetcdfFile file(winds);
    const Frame frame = read_frame(file);
    std::optional<NetcdfFile> gusts;
    if (!turbulence.empty())
    {
        gusts.emplace(turbulence);
        if (const std::size_t n = gusts->slices("txx"); n != 1 && n != file.slices("u"))
            throw Error(fmt::format("{} has {} time slices, but {} has {}", turbulence.string(), n,
                                    winds.string(), file.slices("u")));
    }
    std::vector<WindSlice> slices;
    for (const double time : read_times(file))
    {
        const std::size_t number = slices.size();
        WindSlice& slice = slices.emplace_back();
        slice.time_s = time;
        slice.wind = read_winds(file, frame, number);
        if (slice.wind.solid != slices[0].wind.solid)
            throw Error(fmt::format("{}: its solid cells (icellflag) change with time; flakes need one world",
                                    winds.string()));
        if (gusts) read_turbulence(*gusts, frame, number, slice);
    }
    return slices;
}

}  // namespace

std::vector<WindSlice> read_wind_file(const std::filesystem::path& winds,
                                      const std::filesystem::path& turbulence)
{
    if (winds.extension() == ".dat") return read_quic_files(winds, turbulence);
    if (try_in_child([&] { read_both(winds, turbulence); }, kLongestRead_s) != ChildFate::returned)
        throw Error(fmt::format(
            "{}{}{} cannot be read: broken so that the NetCDF library fails on it; write it again",
            winds.string(), turbulence.empty() ? "" : " or ", turbulence.string()));
    return read_both(winds, turbulence);
}

}  // namespace spindrift::scene
