// SPDX-License-Identifier: MIT
#include "scene/write_wind.h"

#include <fmt/format.h>
#include <netcdf.h>

#include <cmath>
#include <string>

#include "core/turbulence.h"
#include "scene/netcdf_writer.h"

namespace spindrift::scene
{

namespace
{

using Attributes = std::vector<std::pair<std::string, std::string>>;

/// The arrays of the file: a layer of cells under the ground first.
class WindLayout
{
  public:
    explicit WindLayout(const GriddedWind& wind)
        : wind_(wind.solved.wind), zone_(wind.solved.zone), flow_(wind.flow)
    {
    }

    int nx() const { return wind_.size.nx; }
    int ny() const { return wind_.size.ny; }
    int nz() const { return wind_.size.nz + 1; }

    std::vector<float> axis(int n, double cell, double first) const
    {
        std::vector<float> at;
        for (int i = 0; i < n; ++i) at.push_back(static_cast<float>(first + i * cell));
        return at;
    }

    /// `value(x, y, z)` on (nz + 1) (ny + 1) (nx + 1) faces, z counted from the first fluid layer; 0 where
    /// the component has no face.
    template <class Value>
    std::vector<float> faces(GridSize n, Value value) const
    {
        std::vector<float> out;
        for (int z = -1; z < nz(); ++z)
            for (int y = 0; y <= ny(); ++y)
                for (int x = 0; x <= nx(); ++x)
                {
                    const bool any = z >= 0 && z < n.nz && y < n.ny && x < n.nx;
                    out.push_back(any ? static_cast<float>(value[n.index(x, y, z)]) : 0.0F);
                }
        return out;
    }

    /// `value(i)` of every cell; `below` under the ground.
    template <class T, class Value>
    std::vector<T> cells(T below, Value value) const
    {
        const std::size_t plane = static_cast<std::size_t>(nx()) * static_cast<std::size_t>(ny());
        std::vector<T> out(plane, below);
        for (std::size_t i = 0; i < wind_.size.count(); ++i) out.push_back(value(i));
        return out;
    }

    std::vector<int> flags() const
    {
        return cells<int>(static_cast<int>(WindZone::terrain),
                          [&](std::size_t i)
                          {
                              const WindZone zone =
                                  zone_[i] == WindZone::separated ? WindZone::fluid : zone_[i];
                              return static_cast<int>(zone);
                          });
    }

    std::vector<float> terrain_m() const
    {
        const std::size_t plane = static_cast<std::size_t>(nx()) * static_cast<std::size_t>(ny());
        std::vector<float> height(plane, 0);
        for (std::size_t i = 0; i < zone_.size(); ++i)
            if (zone_[i] == WindZone::terrain)
                height[i % plane] = static_cast<float>(static_cast<double>(i / plane + 1) * wind_.cell_m.z);
        return height;
    }

    const StaggeredWind& wind_;
    const std::vector<WindZone>& zone_;
    const FlowField& flow_;
};

void define(NetcdfWriter& out, const WindLayout& layout, Vec3d origin_m)
{
    const auto n = [](int v) { return static_cast<std::size_t>(v); };
    out.dimension("t", 0);
    out.dimension("dateStrLen", 19);
    out.dimension("x", n(layout.nx()));
    out.dimension("y", n(layout.ny()));
    out.dimension("z", n(layout.nz()));
    out.dimension("x_face", n(layout.nx() + 1));
    out.dimension("y_face", n(layout.ny() + 1));
    out.dimension("z_face", n(layout.nz() + 1));
    out.attribute("Conventions", "CF-1.8");
    out.attribute("title", "mean wind and turbulence");
    out.attribute("source", "spindrift wind");
    out.attribute("origin_m", fmt::format("{:.17g} {:.17g} {:.17g}", origin_m.x, origin_m.y, origin_m.z));
    const auto axis = [&](const char* name, const char* letter, const char* what)
    {
        Attributes a{{"units", "m"}, {"axis", letter}, {"long_name", what}};
        if (*letter == 'Z') a.emplace_back("positive", "up");
        out.variable(name, NC_FLOAT, {name}, a);
    };
    out.variable("t", NC_DOUBLE, {"t"}, {{"units", "seconds since 2000-01-01 00:00:00"}, {"axis", "T"}});
    out.variable("timestamp", NC_CHAR, {"t", "dateStrLen"});
    axis("x", "X", "distance to the east");
    axis("y", "Y", "distance to the north");
    axis("z", "Z", "height; the first layer is under the ground");
    for (const char* face : {"x_face", "y_face", "z_face"})
        out.variable(face, NC_FLOAT, {face}, {{"units", "m"}});
    out.variable("dz_array", NC_FLOAT, {"z"}, {{"units", "m"}, {"long_name", "thickness of the layers"}});
    out.variable("terrain", NC_FLOAT, {"y", "x"}, {{"units", "m"}, {"long_name", "height of the ground"}});
    for (const char* name : {"u", "v", "w"})
        out.variable(name, NC_FLOAT, {"t", "z_face", "y_face", "x_face"},
                     {{"units", "m s-1"}, {"long_name", std::string(name) + " on the lower faces of cells"}});
    out.variable("icellflag", NC_INT, {"t", "z", "y", "x"},
                 {{"long_name", "0 building, 1 air, 2 terrain, 3 upwind, 4 cavity, 5 wake, 6 canyon"}});
    const std::vector<std::string> cells{"t", "z", "y", "x"};
    for (const char* name : {"eastward_wind", "northward_wind", "upward_air_velocity"})
        out.variable(name, NC_FLOAT, cells, {{"units", "m s-1"}, {"standard_name", name}});
    if (layout.flow_.stress.empty()) return;
    for (const char* name : {"txx", "txy", "txz", "tyy", "tyz", "tzz", "tke"})
        out.variable(name, NC_FLOAT, cells, {{"units", "m2 s-2"}});
    out.variable("CoEps", NC_FLOAT, cells, {{"units", "m2 s-3"}, {"long_name", "C0 times dissipation"}});
}

void put_turbulence(NetcdfWriter& out, const WindLayout& layout)
{
    std::vector<Stress<double>> stress;
    for (const Stress<float>& t : layout.flow_.stress)
        stress.push_back(realizable(Stress<double>{t.xx, t.xy, t.xz, t.yy, t.yz, t.zz}));
    const auto put = [&](const char* name, auto part)
    {
        out.put(name,
                layout.cells<float>(0, [&](std::size_t i) { return static_cast<float>(part(stress[i])); }));
    };
    put("txx", [](const Stress<double>& t) { return t.xx; });
    put("txy", [](const Stress<double>& t) { return t.xy; });
    put("txz", [](const Stress<double>& t) { return t.xz; });
    put("tyy", [](const Stress<double>& t) { return t.yy; });
    put("tyz", [](const Stress<double>& t) { return t.yz; });
    put("tzz", [](const Stress<double>& t) { return t.zz; });
    put("tke", [](const Stress<double>& t) { return 0.5 * (t.xx + t.yy + t.zz); });
    out.put("CoEps", layout.cells<float>(0, [&](std::size_t i) { return layout.flow_.c0_eps[i]; }));
}

}  // namespace

void write_wind(const std::filesystem::path& file, const GriddedWind& wind, Vec3d origin_m)
{
    const WindLayout layout(wind);
    const StaggeredWind& faces = wind.solved.wind;
    const Vec3d cell = faces.cell_m;
    NetcdfWriter out(file);
    define(out, layout, origin_m + wind.solved.low_m);
    out.end_definitions();
    out.put("t", std::vector<double>{0});
    out.put("timestamp", std::string("2000-01-01T00:00:00"));
    out.put("x", layout.axis(layout.nx(), cell.x, 0.5 * cell.x));
    out.put("y", layout.axis(layout.ny(), cell.y, 0.5 * cell.y));
    out.put("z", layout.axis(layout.nz(), cell.z, -0.5 * cell.z));
    out.put("x_face", layout.axis(layout.nx() + 1, cell.x, 0));
    out.put("y_face", layout.axis(layout.ny() + 1, cell.y, 0));
    out.put("z_face", layout.axis(layout.nz() + 1, cell.z, -cell.z));
    out.put("dz_array",
            std::vector<float>(static_cast<std::size_t>(layout.nz()), static_cast<float>(cell.z)));
    out.put("terrain", layout.terrain_m());
    out.put("u", layout.faces(faces.u_size(), faces.u));
    out.put("v", layout.faces(faces.v_size(), faces.v));
    out.put("w", layout.faces(faces.w_size(), faces.w));
    out.put("icellflag", layout.flags());
    const std::vector<Vec3f>& mean = wind.flow.mean;
    out.put("eastward_wind", layout.cells<float>(0, [&](std::size_t i) { return mean[i].x; }));
    out.put("northward_wind", layout.cells<float>(0, [&](std::size_t i) { return mean[i].y; }));
    out.put("upward_air_velocity", layout.cells<float>(0, [&](std::size_t i) { return mean[i].z; }));
    if (!wind.flow.stress.empty()) put_turbulence(out, layout);
    out.close();
}

}  // namespace spindrift::scene
