// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/phase.h"
#include "core/tone.h"
#include "core/vec.h"
#include "core/visibility.h"
#include "core/world.h"

namespace spindrift::scene
{

// A scene as its file states it, validated, immutable afterwards. Lengths are metres in the world frame of
// the file (z up); directions of wind follow the meteorological habit (where it blows FROM, degrees clockwise
// from north = +y). docs/scenes.md lists every key with unit, range and default.

/// Linear scene-referred colour, Rec.709 primaries.
struct Colour
{
    float r = 1, g = 1, b = 1;
};

struct DomainSettings
{
    Vec3d min_m{0, 0, 0};
    Vec3d max_m{0, 0, 0};
    OnLeave on_leave = OnLeave::respawn;
};

/// By what the extinction of the air is stated.
enum class AirSource
{
    clear,  ///< flakes alone hide what lies behind them
    visibility,
    snowfall,       ///< rate and crystals of [snow]
    concentration,  ///< snow in the air
    particle_rate,  ///< the report's experiment
    flakes,         ///< as much as the drawn flakes of the sky hide at full size
};

/// How the report's particles per second become a grey value.
enum class ReportFit
{
    cover,   ///< one parameter, monotone
    legacy,  ///< as printed, clamped
};

enum class FogLaw
{
    exponential,
    legacy,  ///< the report's visibility - distance / 600 m, clamped
};

struct AirSettings
{
    AirSource source = AirSource::clear;
    double visibility_m = 1000;
    VisibilityContrast contrast = VisibilityContrast::five_percent;
    double snow_g_m3 = 0.3;
    double particles_per_s = 1e5;
    ReportFit fit = ReportFit::cover;
    FogLaw law = FogLaw::exponential;
    double drift_visibility_m = std::numeric_limits<double>::infinity();  ///< of the drift alone, at its base
    double drift_height_m = 1;  ///< over which the drift falls to 1/e
    double drift_base_m = 0;    ///< world frame
    bool airlight = true;       ///< lamps glow in the fog
};

enum class WindSource
{
    calm,
    uniform,
    logarithmic,
    file,   ///< QES-Winds windsWk and turbOut
    solve,  ///< an approaching wind, zones round blocks, and the projection
};

/// How a wind that is solved for approaches.
enum class InflowKind
{
    logarithmic,
    power,
    measured,
};

/// A measured wind at one height.
struct WindLevel
{
    double height_m = 0;  ///< above the ground
    double speed_m_s = 0;
    double from_direction_deg = 270;
};

struct WindSettings
{
    WindSource source = WindSource::calm;
    double speed_m_s = 0;
    double from_direction_deg = 270;
    double vertical_m_s = 0;
    double reference_height_m = 10;  ///< at which speed_m_s holds (logarithmic)
    double roughness_m = 0.1;
    double friction_velocity_m_s = 0;  ///< > 0: given instead of speed_m_s
    double boundary_layer_m = 1000;
    bool turbulence = true;      ///< surface-layer closure, or the turbulence file
    bool around_solids = false;  ///< logarithmic: put on a grid and made divergence-free round the solids
    double cell_m = 2;           ///< of that grid, and of the one that is solved on

    // solve
    InflowKind profile = InflowKind::logarithmic;
    double exponent = 0.16;              ///< power
    std::vector<WindLevel> levels;       ///< measured; ascending heights
    bool zones = true;                   ///< recirculation, wakes and the like round blocks
    double layer_m = 0;                  ///< thickness of the lowest layer; 0: cell_m
    double layer_growth = 1;             ///< of a layer over the one below it
    std::filesystem::path cache_folder;  ///< empty: nothing is kept

    std::filesystem::path winds_file, turbulence_file;  ///< source = file; turbulence_file may be empty
    bool project = true;  ///< source = file: make the file's wind free of divergence

    double gust_speed_m_s = 0;  ///< root mean square of each horizontal component; 0: no gusts
    double gust_length_m = 60, gust_height_m = 10;
    std::uint64_t gust_seed = 1;

    bool on_grid() const
    {
        return source == WindSource::file || source == WindSource::solve ||
               (source == WindSource::logarithmic && around_solids);
    }
};

struct EmitterSettings
{
    Emitter emitter;              ///< its a, b and c are not set yet
    Vec3d a{}, b{}, c{};          ///< world frame; a sky's b is its size
    double threshold_m_s = 0.25;  ///< drift: friction velocity at which snow begins to move
    std::string follows;          ///< sky: "" fixed, "camera", or the name of a vehicle
};

enum class GroundKind
{
    none,
    plane,
    height_field,
};

struct GroundSettings
{
    GroundKind kind = GroundKind::plane;
    double height_m = 0;         ///< plane; datum of a height field
    std::filesystem::path file;  ///< height field: grey PNG (8 or 16 bit), spans the domain in x and y
    double relief_m = 1;         ///< height of its white above its black
    Surface surface;
    Colour albedo{0.75F, 0.77F, 0.80F};
};

struct BoxSettings
{
    Vec3d min_m{}, max_m{};
    Surface surface;
    Colour albedo{0.5F, 0.5F, 0.5F};
    Colour emission{0, 0, 0};
};

struct ModelSettings
{
    std::filesystem::path file;
    Vec3d position_m{};
    double yaw_deg = 0;
    double scale = 1;
    bool y_up = true;   ///< the file's up axis is y (OBJ and glTF habit); else z
    bool solid = true;  ///< flakes meet it
    Surface surface;
    std::string vehicle;  ///< not empty: drawn at the vehicle's place (and then never solid)
};

enum class LightKind : std::uint32_t
{
    point = 0,
    spot = 1,
    directional = 2,
};

/// The light table of the report (CTS 11-23, section 3.2.4).
struct Light
{
    std::string name;
    bool exists = true;
    bool on = true;
    LightKind kind = LightKind::point;
    bool flashing = false;
    double flash_rate_hz = 1;
    double flash_duty = 0.5;  ///< share of the period that it is on, 0..1
    double flash_phase = 0;   ///< share of the period by which it is ahead, 0..1
    Vec3d position_m{};
    Vec3d direction{0, 0, -1};  ///< unit; the way the light travels (spot, directional)
    Colour intensity;  ///< point, spot: radiant intensity in W/sr; directional: irradiance in W/m2; HDR
    double range_m = std::numeric_limits<double>::infinity();
    double inner_cone_deg = 20, outer_cone_deg = 30;  ///< half angles
    PhaseKind phase = PhaseKind::henyey_greenstein;
    double g = 0.77;          ///< asymmetry of flakes in this light, in (-1, 1)
    double g_back = -0.3;     ///< double_lobe: of the second lobe
    double back_share = 0.1;  ///< double_lobe: share of the light that it takes
    std::string vehicle;      ///< not empty: position and direction are relative to it
    bool shadow = false;      ///< what stands in its way casts one; not for points
};

/// Of the lights that cast shadows.
struct ShadowSettings
{
    int map_px = 1024;    ///< edge of the map of what the scene hides
    int snow_slices = 0;  ///< in which flakes dim the light on its way; 0: they do not
    int snow_px = 128;    ///< edge of a slice
};

struct SkySettings
{
    Colour zenith{0.45F, 0.5F, 0.6F};
    Colour horizon{0.75F, 0.78F, 0.8F};
    Colour ambient{0.6F, 0.62F, 0.66F};  ///< irradiance / pi that reaches everything, once
};

struct CameraKey
{
    double time_s = 0;
    Vec3d eye_m{}, look_at_m{};
};

struct CameraSettings
{
    std::vector<CameraKey> keys;  ///< ascending time, at least one; piecewise linear
    double fov_y_deg = 50;
    double near_m = 0.1, far_m = 1000;
};

struct VehicleSettings
{
    struct Key
    {
        double time_s = 0;
        Vec3d position_m{};
    };
    struct Path
    {
        std::vector<Key> keys;  ///< ascending time, at least one; world frame
    };
    std::string name;
    Path path;
    Vec3d body_m{};  ///< length, width, height of what drags air along; 0: nothing does
};

enum class Blending
{
    over,        ///< sorted, premultiplied over
    additive,    ///< no sort
    weighted,    ///< no sort: all flakes of a pixel share what they cover, nearer ones get more
    stochastic,  ///< no sort: each sample of a pixel is covered by a flake or not, by chance
    opaque,      ///< plain points with depth, no sort
};

/// How flakes scatter light.
enum class Scattering
{
    physical,
    legacy,  ///< as the report prints it: the angle's sign turned round, ambient light once per lamp
};

enum class Sprite
{
    crystal,  ///< Gaussian transparency inside a grown crystal shape
    point,    ///< plain opaque round point
};

/// How blended flakes are drawn; opaque points always by GL's rasteriser.
enum class FlakePath
{
    automatic,  ///< raster on a GPU, tiles on software GL
    raster,     ///< as points, by GL's rasteriser
    tiles,      ///< by the processor, in tiles of the picture
};

struct RenderSettings
{
    int width_px = 1280, height_px = 720;
    double frames_per_s = 30;
    int frames = 90;
    double warm_up_s = 0;  ///< simulated before the first frame
    Blending blending = Blending::over;
    int samples = 8;  ///< of a pixel, stochastic: 2, 4, 8 or 16
    Sprite sprite = Sprite::crystal;
    Scattering scattering = Scattering::physical;
    FlakePath flake_path = FlakePath::automatic;
    std::string sort = "auto";
    int depth_bits = 32;
    int sort_passes_per_frame = 8;  ///< steps of the sorts over frames
    double exposure = 1;
    bool auto_exposure = false;  ///< `exposure` is then found from the picture
    double grey = 0.18;          ///< what the log-average of the picture is shown as
    double adaptation_s = 1;     ///< time constant of the automatic exposure
    /// Lamps without a range get one at which their light has faded to this irradiance; 0: they reach
    /// everything.
    double dimmest_lamp_w_m2 = 0;
    double shutter_s = 0;        ///< how long flakes are seen while they fly; 0: at an instant
    double flake_opacity = 0.9;  ///< at the centre of a flake, 0..1
    double flake_scale = 1;      ///< drawn size over real size; light is kept by weight / scale^2
};

enum class BloomMethod
{
    gaussian,  ///< exact: separable, true weights, at full resolution
    reduced,   ///< the same at an eighth of the resolution, or at a quarter or half for narrow ones
    pyramid,   ///< 13 taps down, tent up
    dual,      ///< dual filter
    legacy,    ///< box of the exact one's taps
};

/// Light in multiples of white after the exposure.
struct BloomSettings
{
    double weight = 0;  ///< share of the bright part that is spread
    BloomMethod method = BloomMethod::reduced;
    double threshold = 1;
    double knee = 0.5;            ///< share of the threshold
    double ceiling = 100;         ///< a pixel counts up to here
    double sigma_px = 128.0 / 3;  ///< in a picture 720 px high; others scale it
};

struct DisplaySettings
{
    ToneCurve tone = ToneCurve::linear;
    double white = 4;  ///< reinhard: luminance that becomes white; legacy: its largest luminance
    bool dither = true;
    double unit_cd_m2 = 0;  ///< luminance that one unit of light stands for; 0: not calibrated
    double white_cd_m2 = 0, black_cd_m2 = 0;  ///< of the display
};

struct Scene
{
    std::filesystem::path file;  ///< it was read from; relative paths start at its folder
    std::string name, about;
    DomainSettings domain;
    double step_s = 1.0 / 60.0;
    std::uint64_t seed = 1;
    std::uint64_t capacity = 0;
    std::uint32_t reorder_every_steps = 16;  ///< 0: never; docs/decisions/013
    Snow snow;
    WindSettings wind;
    AirSettings air;
    std::vector<EmitterSettings> emitters;
    GroundSettings ground;
    std::vector<BoxSettings> boxes;
    std::vector<ModelSettings> models;
    double voxel_m = 1;
    std::vector<Light> lights;
    ShadowSettings shadows;
    SkySettings sky;
    CameraSettings camera;
    std::vector<VehicleSettings> vehicles;
    RenderSettings render;
    BloomSettings bloom;
    DisplaySettings display;
};

/// What a command line may change of a scene before it is validated.
struct SceneOverrides
{
    std::optional<std::uint64_t> particles;  ///< capacity, and bursts and rates scaled with it
    std::optional<std::uint64_t> seed;
    std::optional<std::int64_t> reorder_every_steps;
    std::optional<std::string> sort, flake_path, blending;
    std::optional<int> sort_passes_per_frame;
    std::optional<int> width_px, height_px, frames;
    std::optional<double> frames_per_s, shutter_s;
    std::optional<std::filesystem::path> winds_file, turbulence_file;
};

/// Reads and validates a TOML scene. Throws Error: "file:line: key = value is wrong (why); what is allowed".
Scene read_scene(const std::filesystem::path& file, const SceneOverrides& overrides = {});

/// What a scene says of itself (scene.about), also where the rest of it needs a command line to be whole.
/// Throws Error for a file that cannot be read or is not TOML.
std::string read_about(const std::filesystem::path& file);

/// The same as read_scene from text, for tests and the fuzzer; `name` stands for the file in messages.
Scene parse_scene(std::string_view text, const std::filesystem::path& name,
                  const SceneOverrides& overrides = {});

}  // namespace spindrift::scene
