// SPDX-License-Identifier: MIT
#include "scene/make_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "core/error.h"
#include "core/turbulence.h"
#include "scene/drift.h"
#include "scene/height_field.h"
#include "scene/project_wind.h"
#include "scene/voxelise.h"
#include "scene/wind_file.h"

namespace spindrift::scene
{

namespace
{

constexpr std::size_t kMostSurfaces = 256;

Vec3f narrow(const Vec3d& v)
{
    return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

Vec3d widen(const Vec3f& v)
{
    return {v.x, v.y, v.z};
}

std::filesystem::path beside_scene(const Scene& scene, const std::filesystem::path& file)
{
    return file.empty() || file.is_absolute() ? file : scene.file.parent_path() / file;
}

class Builder
{
  public:
    Builder(const Scene& scene, const Geometry& geometry, const WindProjector& project, GriddedWind* kept)
        : scene_(scene), geometry_(geometry), project_(project), kept_(kept)
    {
    }

    World build()
    {
        const Vec3d size = scene_.domain.max_m - scene_.domain.min_m;
        world_.size_m = narrow(size);
        world_.on_leave = scene_.domain.on_leave;
        world_.step_s = scene_.step_s;
        world_.seed = scene_.seed;
        world_.capacity = scene_.capacity;
        world_.snow = scene_.snow;
        set_ground();
        if (scene_.wind.source == WindSource::file) read_winds();
        fill_solids();
        set_wind();
        // what drifts comes last (core/world.h)
        for (const bool drifts : {false, true})
            for (const EmitterSettings& settings : scene_.emitters)
                if ((settings.emitter.shape == EmitterShape::drift) == drifts) add_emitter(settings);
        return std::move(world_);
    }

  private:
    void set_ground()
    {
        world_.has_ground = scene_.ground.kind != GroundKind::none;
        if (!world_.has_ground) return;
        world_.ground_m = static_cast<float>(scene_.ground.height_m - scene_.domain.min_m.z);
        world_.ground = scene_.ground.surface;
        if (scene_.ground.kind == GroundKind::height_field)
            heights_.emplace(scene_.ground, scene_.domain, scene_.file.parent_path());
    }

    /// The file's fluid layers start at the lowest corner of the domain.
    void read_winds()
    {
        const auto winds = beside_scene(scene_, scene_.wind.winds_file);
        file_ = read_wind_file(winds, beside_scene(scene_, scene_.wind.turbulence_file));
        const StaggeredWind& wind = file_->wind;
        const double x = wind.size.nx * wind.cell_m.x, y = wind.size.ny * wind.cell_m.y;
        if (world_.size_m.x > x + 0.5 * wind.cell_m.x || world_.size_m.y > y + 0.5 * wind.cell_m.y)
            throw Error(fmt::format(
                "{} covers {:g} x {:g} m, but the domain is {:g} x {:g} m; make domain.max_m smaller",
                winds.string(), x, y, static_cast<double>(world_.size_m.x),
                static_cast<double>(world_.size_m.y)));
    }

    std::uint8_t surface_index(const Surface& surface)
    {
        for (std::size_t i = 0; i < world_.surfaces.size(); ++i)
            if (world_.surfaces[i].contact == surface.contact &&
                world_.surfaces[i].restitution == surface.restitution)
                return static_cast<std::uint8_t>(i);
        if (world_.surfaces.size() == kMostSurfaces)
            throw Error(fmt::format(
                "more than {} different surfaces; let things share contact and restitution", kMostSurfaces));
        world_.surfaces.push_back(surface);
        return static_cast<std::uint8_t>(world_.surfaces.size() - 1);
    }

    bool anything_solid() const
    {
        const auto solid = [](const Mesh& mesh) { return mesh.solid && mesh.vehicle.empty(); };
        return heights_ || !scene_.boxes.empty() ||
               std::any_of(geometry_.meshes.begin(), geometry_.meshes.end(), solid) ||
               (file_ &&
                std::find(file_->wind.solid.begin(), file_->wind.solid.end(), 1) != file_->wind.solid.end());
    }

    void fill_solids()
    {
        if (!anything_solid()) return;
        Voxeliser::Height floor;
        if (heights_)
            floor = [this](double x, double y) { return heights_->height_m(x, y); };
        else if (world_.has_ground)
            floor = [ground = static_cast<double>(world_.ground_m)](double, double) { return ground; };
        Voxeliser voxels(world_.size_m, scene_.voxel_m, floor);
        if (heights_) voxels.add_height_field(floor, surface_index(scene_.ground.surface));
        if (file_) add_file_solids(voxels);
        for (const Mesh& mesh : geometry_.meshes)
            if (mesh.solid && mesh.vehicle.empty()) voxels.add_mesh(mesh, surface_index(mesh.surface));
        for (const BoxSettings& box : scene_.boxes)
            voxels.add_box(box.min_m - scene_.domain.min_m, box.max_m - scene_.domain.min_m,
                           surface_index(box.surface));
        world_.voxels = voxels.finish();
        if (world_.voxels.nx == 0) world_.surfaces.clear();
    }

    /// Buildings and terrain of the wind file take the ground's surface.
    void add_file_solids(Voxeliser& voxels)
    {
        const StaggeredWind& wind = file_->wind;
        voxels.add_where(
            [&](const Vec3d& p)
            {
                const auto cell = [](double at, double size, int n)
                { return std::min(static_cast<int>(at / size), n); };
                const int x = cell(p.x, wind.cell_m.x, wind.size.nx),
                          y = cell(p.y, wind.cell_m.y, wind.size.ny),
                          z = cell(p.z, wind.cell_m.z, wind.size.nz);
                return x < wind.size.nx && y < wind.size.ny && z < wind.size.nz &&
                       wind.solid[wind.size.index(x, y, z)] != 0;
            },
            surface_index(scene_.ground.surface));
    }

    void set_wind()
    {
        const WindSettings& settings = scene_.wind;
        Wind& wind = world_.wind;
        const double from = settings.from_direction_deg * (3.14159265358979323846 / 180.0);
        const double to_x = -std::sin(from), to_y = -std::cos(from);
        wind.to_x = static_cast<float>(to_x);
        wind.to_y = static_cast<float>(to_y);
        wind.roughness_m = static_cast<float>(settings.roughness_m);
        wind.boundary_layer_m = static_cast<float>(settings.boundary_layer_m);
        wind.ground_m = world_.has_ground ? world_.ground_m : 0.0F;
        switch (settings.source)
        {
            case WindSource::calm:
                break;
            case WindSource::uniform:
                wind.uniform_m_s =
                    narrow({to_x * settings.speed_m_s, to_y * settings.speed_m_s, settings.vertical_m_s});
                break;
            case WindSource::logarithmic:
                set_logarithmic_wind();
                break;
            case WindSource::file:
                set_file_wind();
                break;
            case WindSource::solve:
                set_solved_wind();
                break;
        }
    }

    void set_logarithmic_wind()
    {
        const WindSettings& settings = scene_.wind;
        Wind& wind = world_.wind;
        const double z0 = settings.roughness_m;
        const double friction =
            settings.friction_velocity_m_s > 0
                ? settings.friction_velocity_m_s
                : kVonKarman * settings.speed_m_s / std::log((settings.reference_height_m + z0) / z0);
        wind.kind = WindKind::logarithmic;
        wind.friction_velocity_m_s = static_cast<float>(friction);
        wind.turbulent = settings.turbulence && friction > 0;
        if (!settings.around_solids) return;
        SolvedWind solved;
        solved.low_m = {0, 0, static_cast<double>(wind.ground_m)};
        const WindProjector note = [&](StaggeredWind& staggered)
        { return solved.projection = project_(staggered); };
        solved.wind = wind_around_solids(wind, world_.size_m, settings.cell_m, world_.voxels, note);
        FlowField flow = cell_means(solved.wind, solved.low_m);
        if (wind.turbulent) close_from_shear({z0, settings.boundary_layer_m, friction}, flow);
        set_grid(std::move(solved), std::move(flow));
    }

    void set_file_wind()
    {
        const WindSettings& settings = scene_.wind;
        SolvedWind solved;
        solved.wind = std::move(file_->wind);
        solved.projection = project_(solved.wind);
        FlowField flow = cell_means(solved.wind, {0, 0, 0});
        flow.stress = std::move(file_->stress);
        flow.c0_eps = std::move(file_->c0_eps);
        file_.reset();
        if (!settings.turbulence)
            flow.stress.clear();
        else if (flow.stress.empty())
            close_from_shear({settings.roughness_m, settings.boundary_layer_m, friction_of(flow)}, flow);
        set_grid(std::move(solved), std::move(flow));
    }

    void set_solved_wind()
    {
        const WindSettings& settings = scene_.wind;
        const double floor = static_cast<double>(world_.wind.ground_m);
        Surroundings around{
            widen(world_.size_m), floor, [floor](double, double) { return floor; }, {}, &world_.voxels};
        if (heights_) around.ground_m = [this](double x, double y) { return heights_->height_m(x, y); };
        for (const BoxSettings& box : scene_.boxes)
        {
            const Vec3d low = box.min_m - scene_.domain.min_m, high = box.max_m - scene_.domain.min_m;
            around.boxes.push_back({{{low, {high.x, low.y, 0}, high, {low.x, high.y, 0}}},
                                    low.z,
                                    high.z,
                                    around.ground_m(0.5 * (low.x + high.x), 0.5 * (low.y + high.y))});
        }
        SolvedWind solved =
            solve_wind(settings, around, project_, beside_scene(scene_, settings.cache_folder));
        FlowField flow = cell_means(solved.wind, solved.low_m);
        const double friction = InflowProfile(settings).friction_velocity_m_s();
        if (settings.turbulence && friction > 0)
            close_from_shear({settings.roughness_m, settings.boundary_layer_m, friction}, flow);
        set_grid(std::move(solved), std::move(flow));
    }

    void set_grid(SolvedWind solved, FlowField flow)
    {
        fill_wind_grid(flow, world_.wind);
        if (kept_ == nullptr) return;
        if (solved.zone.empty())
            for (const std::uint8_t solid : solved.wind.solid)
                solved.zone.push_back(solid != 0 ? WindZone::building : WindZone::fluid);
        *kept_ = {std::move(solved), std::move(flow)};
    }

    /// u* from the mean speed of the highest layer, were it logarithmic.
    double friction_of(const FlowField& flow) const
    {
        const std::size_t layer =
            static_cast<std::size_t>(flow.size.nx) * static_cast<std::size_t>(flow.size.ny);
        double sum = 0;
        for (std::size_t i = flow.mean.size() - layer; i < flow.mean.size(); ++i)
            sum += std::hypot(static_cast<double>(flow.mean[i].x), static_cast<double>(flow.mean[i].y));
        const double height = (flow.size.nz - 0.5) * flow.cell_m.z, z0 = scene_.wind.roughness_m;
        return kVonKarman * sum / static_cast<double>(layer) / std::log((height + z0) / z0);
    }

    void add_emitter(const EmitterSettings& settings)
    {
        Emitter emitter = settings.emitter;
        const auto local = [&](const Vec3d& p) { return narrow(p - scene_.domain.min_m); };
        emitter.a = local(settings.a);
        emitter.b = emitter.shape == EmitterShape::sky ? narrow(settings.b) : local(settings.b);
        emitter.c = local(settings.c);
        if (emitter.shape == EmitterShape::drift)
            world_.grains = set_drift(world_, settings.threshold_m_s, world_.emitters.size() + 1, emitter);
        if (!settings.follows.empty()) emitter.anchor = anchor_index(settings.follows);
        world_.emitters.push_back(emitter);
    }

    /// One anchor for each thing that is followed.
    int anchor_index(const std::string& followed)
    {
        const auto known = std::find(anchor_names_.begin(), anchor_names_.end(), followed);
        if (known != anchor_names_.end()) return static_cast<int>(known - anchor_names_.begin());
        Anchor anchor;
        if (followed == "camera")
        {
            for (const CameraKey& key : scene_.camera.keys)
                anchor.keys.push_back({key.time_s, narrow(key.eye_m - scene_.domain.min_m)});
        }
        else
        {
            const auto vehicle = std::find_if(scene_.vehicles.begin(), scene_.vehicles.end(),
                                              [&](const VehicleSettings& v) { return v.name == followed; });
            if (vehicle == scene_.vehicles.end())
                throw Error(fmt::format("a sky follows '{}', which is not a vehicle", followed));
            for (const VehicleSettings::Key& key : vehicle->path.keys)
                anchor.keys.push_back({key.time_s, narrow(key.position_m - scene_.domain.min_m)});
        }
        anchor_names_.push_back(followed);
        world_.anchors.push_back(std::move(anchor));
        return static_cast<int>(anchor_names_.size()) - 1;
    }

    const Scene& scene_;
    const Geometry& geometry_;
    const WindProjector& project_;
    GriddedWind* kept_;
    World world_;
    std::optional<HeightField> heights_;
    std::optional<WindFile> file_;
    std::vector<std::string> anchor_names_;
};

}  // namespace

World make_world(const Scene& scene, const Geometry& geometry, const WindProjector& project_wind,
                 GriddedWind* kept)
{
    return Builder(scene, geometry, project_wind, kept).build();
}

}  // namespace spindrift::scene
