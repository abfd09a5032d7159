// SPDX-License-Identifier: MIT
#include <array>

#include <fmt/format.h>

#include "scene/describe_scene.h"

namespace spindrift::scene
{
namespace
{

constexpr std::array<Named<BloomMethod>, 5> kMethods{{{BloomMethod::gaussian, "gaussian"},
                                                      {BloomMethod::reduced, "reduced"},
                                                      {BloomMethod::pyramid, "pyramid"},
                                                      {BloomMethod::dual, "dual"},
                                                      {BloomMethod::legacy, "legacy"}}};
constexpr std::array<Named<ToneCurve>, 7> kCurves{{{ToneCurve::linear, "linear"},
                                                   {ToneCurve::reinhard, "reinhard"},
                                                   {ToneCurve::aces, "aces"},
                                                   {ToneCurve::agx, "agx"},
                                                   {ToneCurve::neutral, "neutral"},
                                                   {ToneCurve::calibrated, "calibrated"},
                                                   {ToneCurve::legacy, "legacy"}}};

void describe_bloom(Section& section, BloomSettings& bloom)
{
    section.number({.name = "weight", .about = "share of the bright part that is spread; 0: no bloom"},
                   {.min = 0, .max = 1, .why = "no more light can be spread than is there"}, bloom.weight);
    const bool blooms = bloom.weight > 0;
    constexpr std::string_view kWhen = "with weight above 0";
    section.choice({.name = "method",
                    .about = "how it is spread: exactly, at an eighth of the resolution, by a pyramid of 13 "
                             "taps, by the dual filter, or by the report's box",
                    .applies = blooms,
                    .applies_when = kWhen},
                   kMethods, bloom.method);
    section.number({.name = "threshold",
                    .about = "light that is above it is bright; 1 is white after the exposure",
                    .applies = blooms,
                    .applies_when = kWhen},
                   {.min = 0, .max = 6e4}, bloom.threshold);
    section.number({.name = "knee",
                    .about = "half width over which it sets in, as a share of the threshold",
                    .applies = blooms,
                    .applies_when = kWhen},
                   {.min = 0, .max = 1}, bloom.knee);
    section.number({.name = "ceiling",
                    .about = "a pixel counts up to here, so that a single hot one is no lamp",
                    .applies = blooms,
                    .applies_when = kWhen},
                   {.min = 0, .max = 6e4, .above_min = true, .why = "half floats end at 65504"},
                   bloom.ceiling);
    section.require(bloom.ceiling > bloom.threshold, "ceiling",
                    fmt::format("is not above threshold = {} (nothing would be bright)", bloom.threshold),
                    "use more than threshold");
    section.number({.name = "sigma_px",
                    .about = "standard deviation of the Gaussian in a picture 720 px high; others scale it",
                    .applies = blooms,
                    .applies_when = kWhen},
                   {.min = 4, .max = 200, .why = "narrower is no glow, and wider has no shape on a picture"},
                   bloom.sigma_px);
}

void describe_calibration(Section& section, DisplaySettings& display)
{
    constexpr Range kLuminance{.min = 0, .max = 1e6, .above_min = true};
    section.number({.name = "unit_cd_m2",
                    .about = "luminance that one unit of light stands for: the calibration; without it none "
                             "is logged"},
                   kLuminance, display.unit_cd_m2);
    const bool calibrated = display.unit_cd_m2 > 0;
    constexpr std::string_view kWhen = "with unit_cd_m2";
    section.number({.name = "white_cd_m2",
                    .about = "luminance of the display's white, as measured",
                    .required = true,
                    .applies = calibrated,
                    .applies_when = kWhen},
                   kLuminance, display.white_cd_m2);
    section.number({.name = "black_cd_m2",
                    .about = "luminance of the display's black, as measured",
                    .applies = calibrated,
                    .applies_when = kWhen},
                   {.min = 0, .max = 1e6}, display.black_cd_m2);
    section.require(
        !calibrated || display.black_cd_m2 < display.white_cd_m2, "black_cd_m2",
        fmt::format("is not below white_cd_m2 = {} (the display would show nothing)", display.white_cd_m2),
        "use less than white_cd_m2");
}

void describe_display(Section& section, DisplaySettings& display, const RenderSettings& render)
{
    section.choice(
        {.name = "tone",
         .about = "curve from light to display; neutral keeps contrast and hue below 0.8, calibrated "
                  "shows cd/m2 as they are"},
        kCurves, display.tone);
    section.number({.name = "white",
                    .about = "luminance that becomes white; in legacy the report's largest luminance",
                    .applies = display.tone == ToneCurve::reinhard || display.tone == ToneCurve::legacy,
                    .applies_when = "with tone = \"reinhard\" or \"legacy\""},
                   {.min = 0.01, .max = 1e6}, display.white);
    section.flag({.name = "dither", .about = "hides the steps of 8 bits behind half a step of noise"},
                 display.dither);
    describe_calibration(section, display);
    section.require(display.tone != ToneCurve::legacy || !render.auto_exposure, "tone",
                    "has no gain without a number for render.exposure", "set render.exposure");
    if (display.tone != ToneCurve::calibrated) return;
    section.require(display.unit_cd_m2 > 0, "tone", "has no calibration (no luminance is known)",
                    "give unit_cd_m2 and white_cd_m2");
    section.require(render.exposure == 1 && !render.auto_exposure, "tone",
                    "would not show cd/m2 as they are with a render.exposure other than 1",
                    "take render.exposure away");
}

}  // namespace

void describe_exposure(Section& section, RenderSettings& render)
{
    section.number_or(
        {.name = "exposure",
         .about = "factor on all light before the tone curve; \"auto\": what shows the picture's "
                  "log-average as grey"},
        {.min = 0, .max = 1e6, .above_min = true}, "auto", render.exposure, render.auto_exposure);
    constexpr std::string_view kWhen = "with exposure = \"auto\"";
    section.number({.name = "grey",
                    .about = "share of white as which the log-average is shown",
                    .applies = render.auto_exposure,
                    .applies_when = kWhen},
                   {.min = 0.001, .max = 1}, render.grey);
    section.number({.name = "adaptation_s",
                    .about = "time in which all but 37 % of a change of light is adapted to; 0: at once",
                    .applies = render.auto_exposure,
                    .applies_when = kWhen},
                   {.min = 0, .max = 3600}, render.adaptation_s);
}

void describe_development(Section& root, Scene& scene)
{
    root.section({.name = "bloom", .about = "the glow round what is brighter than white"},
                 [&](Section& s) { describe_bloom(s, scene.bloom); });
    root.section({.name = "display", .about = "how light becomes what a display shows"},
                 [&](Section& s) { describe_display(s, scene.display, scene.render); });
}

}  // namespace spindrift::scene
