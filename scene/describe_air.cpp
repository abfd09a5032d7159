// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <array>
#include <cmath>

#include "scene/describe_scene.h"

namespace spindrift::scene
{
namespace
{

constexpr std::array<Named<Crystal>, 4> kCrystals{{{Crystal::dendrites, "dendrites"},
                                                   {Crystal::plates, "plates"},
                                                   {Crystal::rimed, "rimed"},
                                                   {Crystal::graupel, "graupel"}}};
constexpr std::array<Named<SizeSpectrum>, 2> kSpectra{
    {{SizeSpectrum::gunn_marshall, "gunn-marshall"}, {SizeSpectrum::sekhon_srivastava, "sekhon-srivastava"}}};
constexpr std::array<Named<WindSource>, 5> kSources{{{WindSource::calm, "calm"},
                                                     {WindSource::uniform, "uniform"},
                                                     {WindSource::logarithmic, "log"},
                                                     {WindSource::file, "file"},
                                                     {WindSource::solve, "solve"}}};
constexpr std::array<Named<InflowKind>, 3> kInflows{
    {{InflowKind::logarithmic, "log"}, {InflowKind::power, "power"}, {InflowKind::measured, "measured"}}};

/// 64 B a wind cell: 1 GB.
constexpr double kMostWindCells = 16.0 * 1024 * 1024;

void describe_snow(Section& section, Snow& snow)
{
    section.choice({.name = "crystal", .about = "kind of flake; sets how fast a size falls"}, kCrystals,
                   snow.crystal);
    section.choice({.name = "spectrum", .about = "law of the sizes at a rate of snowfall"}, kSpectra,
                   snow.spectrum);
    section.number(
        {.name = "rate_mm_h", .about = "snowfall as melted water; sets the sizes, not the number of flakes"},
        {.min = 0.01, .max = 100, .why = "the size spectra were measured from drizzle to downpour"},
        snow.rate_mm_h);
    section.number({.name = "fall_speed_spread_m_s",
                    .about = "standard deviation of fall speed between flakes of one size"},
                   {.min = 0, .max = 5}, snow.fall_speed_spread_m_s);
    double speed = 0;
    bool by_size = true;
    if (section.number_or(
            {.name = "fall_speed_m_s",
             .about = "of flakes of every size (0: a tracer), or \"by-size\": by crystal and size"},
            {.min = 0, .max = 20}, "by-size", speed, by_size) &&
        !by_size)
        snow.fall_speed_m_s = static_cast<float>(speed);
    section.number(
        {.name = "weight", .about = "real flakes that one drawn flake stands for, wherever light is counted"},
        {.min = 0, .max = 1e12, .above_min = true}, snow.weight);
    section.flag(
        {.name = "inertia",
         .about = "velocities follow the air within fall speed / g instead of at once: for heavy flakes "
                  "and gusts shorter than that"},
        snow.inertia);
    section.number(
        {.name = "crossing",
         .about = "beta of crossing trajectories: how soon falling flakes leave their eddies; 0: they "
                  "stay in them; 1 to 2 was measured"},
        {.min = 0, .max = 10}, snow.crossing);
}

bool solved(const WindSettings& wind)
{
    return wind.source == WindSource::solve;
}

/// What approaches is a logarithmic profile, alone or before it meets what stands there.
bool log_profile(const WindSettings& wind)
{
    return wind.source == WindSource::logarithmic ||
           (solved(wind) && wind.profile == InflowKind::logarithmic);
}

bool measured_profile(const WindSettings& wind)
{
    return solved(wind) && wind.profile == InflowKind::measured;
}

void describe_level(Section& section, std::vector<WindLevel>& levels)
{
    WindLevel level;
    section.number(
        {.name = "height_m", .about = "above the ground; each above the one before", .required = true},
        {.min = 0.1, .max = 5000}, level.height_m);
    section.require(levels.empty() || level.height_m > levels.back().height_m, "height_m",
                    "is not above the level before it", "list the levels from low to high");
    section.number({.name = "speed_m_s", .about = "there", .required = true}, {.min = 0, .max = 150},
                   level.speed_m_s);
    section.number({.name = "from_direction_deg", .about = "where it blows from there"},
                   {.min = 0, .max = 360}, level.from_direction_deg);
    levels.push_back(level);
}

/// Keys of the approaching wind.
void describe_profile(Section& section, WindSettings& wind)
{
    section.choice(
        {.name = "profile",
         .about = "how the wind approaches: logarithmic, speed over height to a power, or measured levels",
         .applies = solved(wind),
         .applies_when = "with source = \"solve\""},
        kInflows, wind.profile);
    const bool logarithmic = log_profile(wind), layered = logarithmic || solved(wind);
    const bool power = solved(wind) && wind.profile == InflowKind::power;
    const bool friction_given =
        section.number({.name = "friction_velocity_m_s",
                        .about = "u*, instead of speed_m_s",
                        .applies = logarithmic,
                        .applies_when = "with source or profile = \"log\""},
                       {.min = 0, .max = 10, .above_min = true}, wind.friction_velocity_m_s);
    const bool by_speed = (logarithmic && !friction_given) || power;
    section.number(
        {.name = "speed_m_s",
         .about = "speed along the ground, at reference_height_m in a log wind",
         .required = true,
         .applies = wind.source == WindSource::uniform || by_speed,
         .applies_when =
             "with source = \"uniform\", source or profile = \"log\" without friction_velocity_m_s, or "
             "profile = \"power\""},
        {.min = 0, .max = 150, .why = "speed is measured along the wind; turn it with from_direction_deg"},
        wind.speed_m_s);
    section.number({.name = "reference_height_m",
                    .about = "height above the ground at which speed_m_s holds",
                    .applies = by_speed,
                    .applies_when = "with speed_m_s and source other than \"uniform\""},
                   {.min = 0.1, .max = 1000}, wind.reference_height_m);
    section.number({.name = "exponent",
                    .about = "of height in the profile: 0.1 over water, 0.16 over open land, 0.3 over a town",
                    .applies = power,
                    .applies_when = "with profile = \"power\""},
                   {.min = 0, .max = 1}, wind.exponent);
    constexpr std::string_view kWhen = "with source = \"log\" or \"solve\"";
    section.number({.name = "roughness_m",
                    .about = "z0 of the ground: 0.001 snow field, 0.1 farmland, 1 town",
                    .applies = layered,
                    .applies_when = kWhen},
                   {.min = 1e-5, .max = 10}, wind.roughness_m);
    section.number({.name = "boundary_layer_m",
                    .about = "depth of the turbulent layer; turbulence fades towards its top",
                    .applies = layered,
                    .applies_when = kWhen},
                   {.min = 1, .max = 5000}, wind.boundary_layer_m);
    section.require(!by_speed || wind.roughness_m < wind.reference_height_m, "reference_height_m",
                    "is not above roughness_m (the profile is 0 there)",
                    "use a larger height or a smaller roughness_m");
}

void describe_levels(Section& section, WindSettings& wind)
{
    section.sections(
        {.name = "level",
         .about = "measured winds, from low to high; between them linear in the logarithm of height",
         .required = true,
         .applies = measured_profile(wind),
         .applies_when = "with profile = \"measured\""},
        [&](Section& s) { describe_level(s, wind.levels); });
    section.require(!measured_profile(wind) || !wind.levels.empty(), "level",
                    "is empty (no wind was measured)", "give at least one [[wind.level]]");
}

constexpr std::string_view kOnGrid = "with source = \"file\" or \"solve\", or around_solids = true";

/// Keys of the grid on which the mean wind is made to flow round solids.
void describe_wind_grid(Section& section, WindSettings& wind, const DomainSettings& domain)
{
    section.flag({.name = "around_solids",
                  .about = "put the wind on a grid and let it flow round buildings, without wakes",
                  .applies = wind.source == WindSource::logarithmic,
                  .applies_when = "with source = \"log\""},
                 wind.around_solids);
    const bool gridded = wind.around_solids || solved(wind);
    constexpr std::string_view kWhen = "with source = \"solve\"";
    section.number({.name = "cell_m",
                    .about = "cell of that grid",
                    .applies = gridded,
                    .applies_when = "with around_solids = true or source = \"solve\""},
                   {.min = 0.05, .max = 1000}, wind.cell_m);
    section.number({.name = "layer_m",
                    .about = "thickness of its lowest layer; 0: cell_m",
                    .applies = solved(wind),
                    .applies_when = kWhen},
                   {.min = 0, .max = 1000}, wind.layer_m);
    section.number(
        {.name = "layer_growth",
         .about = "of a layer over the one below it while the wind is solved for; flakes and files then "
                  "get even layers of the lowest one's thickness",
         .applies = solved(wind),
         .applies_when = kWhen},
        {.min = 1, .max = 1.3, .why = "beyond 1.3 the layers no longer resolve the profile"},
        wind.layer_growth);
    section.flag({.name = "zones",
                  .about = "recirculation, wakes, canyons and separation round buildings",
                  .applies = solved(wind),
                  .applies_when = kWhen},
                 wind.zones);
    section.file(
        {.name = "cache_folder",
         .about = "solved winds are kept there by a hash of what they come from; without it, nowhere",
         .applies = solved(wind),
         .applies_when = kWhen},
        wind.cache_folder);
    const Vec3d size = domain.max_m - domain.min_m;
    const double layer = solved(wind) && wind.layer_m > 0 ? wind.layer_m : wind.cell_m;
    const double cells =
        std::ceil(size.x / wind.cell_m) * std::ceil(size.y / wind.cell_m) * std::ceil(size.z / layer);
    section.require(
        !gridded || cells <= kMostWindCells, "cell_m",
        fmt::format("gives {:.3g} cells in this domain (at 64 B a cell {:.1f} GB)", cells, cells * 64e-9),
        fmt::format("use larger cells, at most {:.0f} of them", kMostWindCells));
}

void describe_wind_files(Section& section, WindSettings& wind)
{
    const bool file = wind.source == WindSource::file;
    constexpr std::string_view kWhen = "with source = \"file\"";
    section.file(
        {.name = "winds_file",
         .about = "QES-Winds *_windsWk.nc or QUIC QU_velocity.dat; also by --wind on the command line; "
                  "its time slices are mixed by time, the last one holds on",
         .required = true,
         .applies = file,
         .applies_when = kWhen},
        wind.winds_file);
    section.file({.name = "turbulence_file",
                  .about = "QES-Winds *_turbOut.nc or QUIC QP_turbfield.dat; also by --turbulence",
                  .applies = file,
                  .applies_when = kWhen},
                 wind.turbulence_file);
    section.flag({.name = "project",
                  .about = "take the divergence out of the file's wind (flakes would gather where it is "
                           "negative); false believes the file",
                  .applies = file,
                  .applies_when = kWhen},
                 wind.project);
}

void describe_gusts(Section& section, WindSettings& wind)
{
    section.number(
        {.name = "speed_m_s",
         .about = "root mean square of each horizontal component at reference_height_m; 0: no gusts"},
        {.min = 0, .max = 50}, wind.gust_speed_m_s);
    section.number({.name = "length_m",
                    .about = "of the longest waves; the shortest are an eighth of it, and walls are felt "
                             "within a quarter of it"},
                   {.min = 1, .max = 1e5}, wind.gust_length_m);
    section.number({.name = "reference_height_m",
                    .about = "above the ground; lower down gusts fall off as the logarithmic wind does"},
                   {.min = 0.1, .max = 1000}, wind.gust_height_m);
    section.whole({.name = "seed", .about = "the same seed gives the same gusts"},
                  {.min = 0, .max = 9.2e18, .allowed = "0 to 9.2e18"}, wind.gust_seed);
}

void describe_wind(Section& section, WindSettings& wind, const DomainSettings& domain)
{
    section.choice(
        {.name = "source",
         .about = "still air, one velocity, a logarithmic profile, a wind model's files, or a wind "
                  "that is solved for round what stands there"},
        kSources, wind.source);
    describe_profile(section, wind);
    const bool blows =
        wind.source == WindSource::uniform || log_profile(wind) || (solved(wind) && !measured_profile(wind));
    section.number(
        {.name = "from_direction_deg",
         .about = "where it blows from, clockwise from north (+y): 270 is towards +x",
         .applies = blows,
         .applies_when = "with source = \"uniform\", \"log\", or \"solve\" unless profile = \"measured\""},
        {.min = 0, .max = 360}, wind.from_direction_deg);
    section.number({.name = "vertical_m_s",
                    .about = "speed of the air upwards",
                    .applies = wind.source == WindSource::uniform,
                    .applies_when = "with source = \"uniform\""},
                   {.min = -50, .max = 50}, wind.vertical_m_s);
    describe_wind_grid(section, wind, domain);
    describe_wind_files(section, wind);

    const bool may_be_turbulent =
        wind.source == WindSource::logarithmic || wind.source == WindSource::file || solved(wind);
    const bool given = section.flag(
        {.name = "turbulence",
         .about =
             "gusts: of the neutral surface layer, or of turbulence_file (without one the default is false)",
         .applies = may_be_turbulent,
         .applies_when = "with source = \"log\", \"file\" or \"solve\""},
        wind.turbulence);
    const bool has_file = !wind.turbulence_file.empty();
    if (!given) wind.turbulence = wind.source == WindSource::logarithmic || solved(wind) || has_file;
    section.require(wind.turbulence || !has_file || wind.source != WindSource::file, "turbulence",
                    "contradicts turbulence_file (the gusts of a wind file come from that file)",
                    "leave out one of the two");
    describe_levels(section, wind);
    section.section({.name = "gusts",
                     .about = "large eddies that are carried along as they are, over the mean wind",
                     .applies = wind.on_grid(),
                     .applies_when = kOnGrid},
                    [&](Section& s) { describe_gusts(s, wind); });
}

}  // namespace

void describe_air(Section& root, Scene& scene)
{
    root.section({.name = "snow", .about = "size, speed and number of the flakes"},
                 [&](Section& s) { describe_snow(s, scene.snow); });
    root.section({.name = "wind", .about = "the air that carries them"},
                 [&](Section& s) { describe_wind(s, scene.wind, scene.domain); });
}

}  // namespace spindrift::scene
