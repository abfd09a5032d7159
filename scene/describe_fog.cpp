// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "scene/describe_scene.h"

namespace spindrift::scene
{
namespace
{

constexpr std::array<Named<AirSource>, 6> kSources{{{AirSource::clear, "clear"},
                                                    {AirSource::visibility, "visibility"},
                                                    {AirSource::snowfall, "snowfall"},
                                                    {AirSource::concentration, "concentration"},
                                                    {AirSource::particle_rate, "particle-rate"},
                                                    {AirSource::flakes, "flakes"}}};
constexpr std::array<Named<VisibilityContrast>, 2> kContrasts{
    {{VisibilityContrast::five_percent, "5%"}, {VisibilityContrast::two_percent, "2%"}}};
constexpr std::array<Named<ReportFit>, 2> kFits{{{ReportFit::cover, "cover"}, {ReportFit::legacy, "legacy"}}};
constexpr std::array<Named<FogLaw>, 2> kLaws{
    {{FogLaw::exponential, "exponential"}, {FogLaw::legacy, "legacy"}}};

constexpr Range kVisibility{
    .min = 1,
    .max = 1e6,
    .why = "nearer than 1 m nothing is left to see, beyond 1000 km the air itself hides more"};

void describe_amount(Section& section, AirSettings& air)
{
    section.choice(
        {.name = "source",
         .about = "what says how thick the air is: nothing (flakes alone hide), a visibility, rate and "
                  "crystals of [snow], snow in the air, the report's particles per second, or the drawn "
                  "flakes of the sky themselves"},
        kSources, air.source);
    const bool visibility = air.source == AirSource::visibility;
    const bool rate = air.source == AirSource::particle_rate;
    section.number({.name = "visibility_m",
                    .about = "how far one sees",
                    .required = true,
                    .applies = visibility,
                    .applies_when = "with source = \"visibility\""},
                   kVisibility, air.visibility_m);
    section.number({.name = "snow_g_m3",
                    .about = "snow in the air (Stallabrass 1985)",
                    .required = true,
                    .applies = air.source == AirSource::concentration,
                    .applies_when = "with source = \"concentration\""},
                   {.min = 0, .max = 100, .above_min = true}, air.snow_g_m3);
    section.number({.name = "particles_per_s",
                    .about = "past the report's black rectangle; 600 m of visibility without snow",
                    .required = true,
                    .applies = rate,
                    .applies_when = "with source = \"particle-rate\""},
                   {.min = 0, .max = 1e9}, air.particles_per_s);
    section.choice({.name = "fit",
                    .about = "of that rate: monotone with one parameter, or the report's, clamped",
                    .applies = rate,
                    .applies_when = "with source = \"particle-rate\""},
                   kFits, air.fit);
}

void describe_drift(Section& section, AirSettings& air, const Scene& scene)
{
    section.number({.name = "drift_visibility_m",
                    .about = "of drifting snow alone, at its base; it comes on top and thins out upwards"},
                   kVisibility, air.drift_visibility_m);
    const bool drifts = std::isfinite(air.drift_visibility_m);
    constexpr std::string_view kWhen = "with drift_visibility_m";
    section.number({.name = "drift_height_m",
                    .about = "over which drifting snow falls to 1/e",
                    .applies = drifts,
                    .applies_when = kWhen},
                   {.min = 0.01, .max = 1e4}, air.drift_height_m);
    air.drift_base_m = scene.ground.kind == GroundKind::none ? scene.domain.min_m.z : scene.ground.height_m;
    section.number({.name = "drift_base_m",
                    .about = "height below which drifting snow is no denser; by default that of the ground",
                    .applies = drifts,
                    .applies_when = kWhen},
                   kCoordinate, air.drift_base_m);
}

void describe_air_section(Section& section, const Scene& scene, AirSettings& air)
{
    describe_amount(section, air);
    describe_drift(section, air, scene);
    const bool thick = air.source != AirSource::clear || std::isfinite(air.drift_visibility_m);
    const bool by_eye = air.source == AirSource::visibility || air.source == AirSource::particle_rate ||
                        std::isfinite(air.drift_visibility_m);
    section.choice(
        {.name = "contrast",
         .about = "what a visibility leaves of a black thing's contrast: 5% as WMO, 2% as Koschmieder",
         .applies = by_eye,
         .applies_when = "with a visibility or source = \"particle-rate\""},
        kContrasts, air.contrast);
    section.choice(
        {.name = "law",
         .about = "exp(-extinction · distance), or the report's straight line (visibility - distance / "
                  "600 m, beyond the flakes)",
         .applies = thick,
         .applies_when = "with thick air"},
        kLaws, air.law);
    section.require(air.law != FogLaw::legacy || !std::isfinite(air.drift_visibility_m), "law",
                    "= \"legacy\" knows no drifting snow (the report's line has no height)",
                    "leave out drift_visibility_m, or use \"exponential\"");
    section.flag({.name = "airlight",
                  .about = "whether lamps glow in thick air",
                  .applies = thick && air.law == FogLaw::exponential,
                  .applies_when = "with thick air and law = \"exponential\""},
                 air.airlight);
    const auto skies =
        std::count_if(scene.emitters.begin(), scene.emitters.end(),
                      [](const EmitterSettings& e) { return e.emitter.shape == EmitterShape::sky; });
    section.require(
        air.source != AirSource::flakes || skies == 1, "source",
        fmt::format("= \"flakes\" needs a sky whose flakes say how thick the air is; there are {}", skies),
        "use exactly one [[emitter]] with shape = \"sky\", or another source");
    section.require(
        !thick || skies <= 1, "source",
        fmt::format("cannot be closed round {} skies (fog fills what one volume of flakes leaves)", skies),
        "use at most one [[emitter]] with shape = \"sky\", or source = \"clear\"");
}

}  // namespace

void describe_fog(Section& root, Scene& scene)
{
    root.section({.name = "air", .about = "how thick the air is beyond the flakes that are drawn"},
                 [&](Section& s) { describe_air_section(s, scene, scene.air); });
}

}  // namespace spindrift::scene
