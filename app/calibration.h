// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

namespace spindrift::app
{

/// Particles per second and the mean grey (0 to 255) of a black rectangle behind them.
struct GreyReading
{
    double per_s, grey;
};

/// The report's table 3.2 (CTS 11-04).
inline constexpr std::array<GreyReading, 11> kReportTable{{{100, 0.108},
                                                           {500, 0.845},
                                                           {1e3, 1.730},
                                                           {1e4, 17.182},
                                                           {25e3, 39.891},
                                                           {50e3, 77.006},
                                                           {75e3, 105.350},
                                                           {100e3, 124.800},
                                                           {250e3, 183.600},
                                                           {500e3, 246.175},
                                                           {1e6, 255}}};

/// What one reading says beside the report's.
struct CalibrationRow
{
    GreyReading reading;
    double fitted;        ///< grey by the fitted curve
    double legacy;        ///< by the report's fit, clamped
    double visibility_m;  ///< the report's: (1 - fitted / 255) of 600 m
    double per_m;  ///< extinction: -log(1 - grey / 255) over the depth of snow before the rectangle; infinite
                   ///< if nothing is left of its black
};

struct Calibration
{
    double cover_s = 0;   ///< k of grey = 255 (1 - exp(-k x)), least squares
    double rms_grey = 0;  ///< of the residuals
    double depth_m = 0;   ///< of the snow before the rectangle
    std::vector<CalibrationRow> rows;
};

/// Readings need a grey above 0 at least once.
Calibration calibrate(std::span<const GreyReading> readings, double depth_m);

/// Columns with units in their names; the report's value is empty at rates that its table does not have.
std::string to_csv(const Calibration& calibration);
/// Readings, fitted curve and the report's table over the rate (logarithmic), self-contained.
std::string to_svg(const Calibration& calibration);

}  // namespace spindrift::app
