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
constexpr std::array<Named<WindSource>, 4> kSources{{{WindSource::calm, "calm"},
                                                     {WindSource::uniform, "uniform"},
                                                     {WindSource::logarithmic, "log"},
                                                     {WindSource::file, "file"}}};

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
    section.number(
        {.name = "weight", .about = "real flakes that one drawn flake stands for, wherever light is counted"},
        {.min = 0, .max = 1e12, .above_min = true}, snow.weight);
}

/// Keys of the surface-layer profile.
void describe_profile(Section& section, WindSettings& wind)
{
    const bool logarithmic = wind.source == WindSource::logarithmic;
    constexpr std::string_view kWhen = "with source = \"log\"";
    const bool friction_given =
        section.number({.name = "friction_velocity_m_s",
                        .about = "u*, instead of speed_m_s",
                        .applies = logarithmic,
                        .applies_when = kWhen},
                       {.min = 0, .max = 10, .above_min = true}, wind.friction_velocity_m_s);
    const bool speed_applies = wind.source == WindSource::uniform || (logarithmic && !friction_given);
    section.number(
        {.name = "speed_m_s",
         .about = "speed along the ground, at reference_height_m in a log wind",
         .required = true,
         .applies = speed_applies,
         .applies_when = "with source = \"uniform\", or \"log\" without friction_velocity_m_s"},
        {.min = 0, .max = 150, .why = "speed is measured along the wind; turn it with from_direction_deg"},
        wind.speed_m_s);
    section.number({.name = "reference_height_m",
                    .about = "height above the ground at which speed_m_s holds",
                    .applies = logarithmic && !friction_given,
                    .applies_when = "with source = \"log\" without friction_velocity_m_s"},
                   {.min = 0.1, .max = 1000}, wind.reference_height_m);
    section.number({.name = "roughness_m",
                    .about = "z0 of the ground: 0.001 snow field, 0.1 farmland, 1 town",
                    .applies = logarithmic,
                    .applies_when = kWhen},
                   {.min = 1e-5, .max = 10}, wind.roughness_m);
    section.number({.name = "boundary_layer_m",
                    .about = "depth of the turbulent layer; turbulence fades towards its top",
                    .applies = logarithmic,
                    .applies_when = kWhen},
                   {.min = 1, .max = 5000}, wind.boundary_layer_m);
    section.require(!logarithmic || friction_given || wind.roughness_m < wind.reference_height_m,
                    "reference_height_m", "is not above roughness_m (the profile is 0 there)",
                    "use a larger height or a smaller roughness_m");
}

/// Keys of the grid on which the mean wind is made to flow round solids.
void describe_wind_grid(Section& section, WindSettings& wind, const DomainSettings& domain)
{
    const bool logarithmic = wind.source == WindSource::logarithmic;
    section.flag({.name = "around_solids",
                  .about = "put the wind on a grid and let it flow round buildings",
                  .applies = logarithmic,
                  .applies_when = "with source = \"log\""},
                 wind.around_solids);
    section.number({.name = "cell_m",
                    .about = "cell of that grid",
                    .applies = wind.around_solids,
                    .applies_when = "with around_solids = true"},
                   {.min = 0.05, .max = 1000}, wind.cell_m);
    const Vec3d size = domain.max_m - domain.min_m;
    const double cells =
        std::ceil(size.x / wind.cell_m) * std::ceil(size.y / wind.cell_m) * std::ceil(size.z / wind.cell_m);
    section.require(
        !wind.around_solids || cells <= kMostWindCells, "cell_m",
        fmt::format("gives {:.3g} cells in this domain (at 64 B a cell {:.1f} GB)", cells, cells * 64e-9),
        fmt::format("use larger cells, at most {:.0f} of them", kMostWindCells));
}

void describe_wind_files(Section& section, WindSettings& wind)
{
    const bool file = wind.source == WindSource::file;
    constexpr std::string_view kWhen = "with source = \"file\"";
    section.file({.name = "winds_file",
                  .about = "QES-Winds *_windsWk.nc; also by --wind on the command line",
                  .required = true,
                  .applies = file,
                  .applies_when = kWhen},
                 wind.winds_file);
    section.file({.name = "turbulence_file",
                  .about = "QES-Winds *_turbOut.nc; also by --turbulence",
                  .applies = file,
                  .applies_when = kWhen},
                 wind.turbulence_file);
}

void describe_wind(Section& section, WindSettings& wind, const DomainSettings& domain)
{
    section.choice({.name = "source",
                    .about = "still air, one velocity, a logarithmic profile, or a wind model's files"},
                   kSources, wind.source);
    const bool blows = wind.source == WindSource::uniform || wind.source == WindSource::logarithmic;
    describe_profile(section, wind);
    section.number({.name = "from_direction_deg",
                    .about = "where it blows from, clockwise from north (+y): 270 is towards +x",
                    .applies = blows,
                    .applies_when = "with source = \"uniform\" or \"log\""},
                   {.min = 0, .max = 360}, wind.from_direction_deg);
    section.number({.name = "vertical_m_s",
                    .about = "speed of the air upwards",
                    .applies = wind.source == WindSource::uniform,
                    .applies_when = "with source = \"uniform\""},
                   {.min = -50, .max = 50}, wind.vertical_m_s);
    describe_wind_grid(section, wind, domain);
    describe_wind_files(section, wind);

    const bool may_be_turbulent = wind.source == WindSource::logarithmic || wind.source == WindSource::file;
    const bool given = section.flag(
        {.name = "turbulence",
         .about =
             "gusts: of the neutral surface layer, or of turbulence_file (without one the default is false)",
         .applies = may_be_turbulent,
         .applies_when = "with source = \"log\" or \"file\""},
        wind.turbulence);
    const bool has_file = !wind.turbulence_file.empty();
    if (!given) wind.turbulence = wind.source == WindSource::logarithmic || has_file;
    section.require(wind.turbulence || !has_file || wind.source != WindSource::file, "turbulence",
                    "contradicts turbulence_file (the gusts of a wind file come from that file)",
                    "leave out one of the two");
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
