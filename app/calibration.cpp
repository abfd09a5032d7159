// SPDX-License-Identifier: MIT
#include "app/calibration.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/visibility.h"

namespace spindrift::app
{

namespace
{

double squared_residuals(std::span<const GreyReading> readings, double cover_s)
{
    double sum = 0;
    for (const GreyReading& r : readings)
    {
        const double off = cover_grey(r.per_s, cover_s) - r.grey;
        sum += off * off;
    }
    return sum;
}

/// Golden section over the exponent: the sum of squares has one minimum, far inside the bounds.
double fit_cover(std::span<const GreyReading> readings)
{
    const double ratio = 0.5 * (std::sqrt(5.0) - 1);
    double low = std::log(1e-12), high = std::log(1.0);
    for (int i = 0; i < 100; ++i)
    {
        const double a = high - ratio * (high - low), b = low + ratio * (high - low);
        if (squared_residuals(readings, std::exp(a)) < squared_residuals(readings, std::exp(b)))
            high = b;
        else
            low = a;
    }
    return std::exp(0.5 * (low + high));
}

const GreyReading* reported_at(double per_s)
{
    const auto found = std::find_if(kReportTable.begin(), kReportTable.end(),
                                    [&](const GreyReading& r) { return r.per_s == per_s; });
    return found == kReportTable.end() ? nullptr : &*found;
}

// The plot: 10 to 10 million particles a second, 0 to 255.
constexpr double kLeft = 60, kTop = 20, kWidth = 560, kHeight = 340;

double plot_x(double per_s)
{
    return kLeft + kWidth * (std::log10(per_s) - 1) / 6;
}
double plot_y(double grey)
{
    return kTop + kHeight * (1 - grey / 255);
}

template <class Curve>
std::string path(const Curve& curve, const char* style)
{
    std::string d;
    for (int i = 0; i <= 300; ++i)
    {
        const double per_s = std::pow(10, 1 + 6.0 * i / 300);
        d += fmt::format("{}{:.1f},{:.1f} ", i == 0 ? "M" : "L", plot_x(per_s), plot_y(curve(per_s)));
    }
    return fmt::format("<path d=\"{}\" fill=\"none\" {}/>\n", d, style);
}

std::string axes()
{
    std::string svg =
        fmt::format("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#888\"/>\n",
                    kLeft, kTop, kWidth, kHeight);
    for (int power = 1; power <= 7; ++power)
        svg += fmt::format("<text x=\"{:.0f}\" y=\"{}\" text-anchor=\"middle\">1e{}</text>\n",
                           plot_x(std::pow(10, power)), kTop + kHeight + 18, power);
    for (const int grey : {0, 50, 100, 150, 200, 250})
        svg += fmt::format("<text x=\"{}\" y=\"{:.0f}\" text-anchor=\"end\">{}</text>\n", kLeft - 6,
                           plot_y(grey) + 4, grey);
    svg += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">particles per second</text>\n",
                       kLeft + kWidth / 2, kTop + kHeight + 36);
    svg += fmt::format(
        "<text transform=\"translate(16,{}) rotate(-90)\" text-anchor=\"middle\">mean grey</text>\n",
        kTop + kHeight / 2);
    return svg;
}

}  // namespace

Calibration calibrate(std::span<const GreyReading> readings, double depth_m)
{
    Calibration result;
    result.cover_s = fit_cover(readings);
    result.rms_grey =
        std::sqrt(squared_residuals(readings, result.cover_s) / static_cast<double>(readings.size()));
    result.depth_m = depth_m;
    for (const GreyReading& reading : readings)
    {
        const double fitted = cover_grey(reading.per_s, result.cover_s);
        const double left = std::max(1 - reading.grey / 255, 0.0);
        result.rows.push_back({reading, fitted, report_grey(reading.per_s), report_visibility_m(fitted),
                               -std::log(left) / depth_m});
    }
    return result;
}

std::string to_csv(const Calibration& calibration)
{
    std::string csv =
        "particles_per_s,grey,fitted_grey,residual_grey,report_grey,report_fit_grey,report_fit_residual_grey,"
        "report_visibility_m,extinction_per_m,visibility_5_percent_m\n";
    for (const CalibrationRow& row : calibration.rows)
    {
        const GreyReading* report = reported_at(row.reading.per_s);
        csv += fmt::format("{:g},{:.4f},{:.4f},{:.4f},{},{:.4f},{},{:.2f},{:.6g},{:.6g}\n", row.reading.per_s,
                           row.reading.grey, row.fitted, row.reading.grey - row.fitted,
                           report ? fmt::format("{:.3f}", report->grey) : "", row.legacy,
                           report ? fmt::format("{:.4f}", report->grey - row.legacy) : "", row.visibility_m,
                           row.per_m, visibility_of_extinction(row.per_m, VisibilityContrast::five_percent));
    }
    return csv;
}

std::string to_svg(const Calibration& calibration)
{
    std::string svg = fmt::format(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"640\" height=\"410\" font-family=\"sans-serif\" "
        "font-size=\"12\">\n<rect width=\"640\" height=\"410\" fill=\"white\"/>\n{}",
        axes());
    svg += path([&](double x) { return cover_grey(x, calibration.cover_s); },
                "stroke=\"#06c\" stroke-width=\"2\"");
    svg += path([](double x) { return cover_grey(x, kReportCover_s); }, "stroke=\"#c60\"");
    svg += path([](double x) { return report_grey(x); }, "stroke=\"#c60\" stroke-dasharray=\"4 3\"");
    for (const CalibrationRow& row : calibration.rows)
        svg += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"#06c\"/>\n",
                           plot_x(row.reading.per_s), plot_y(row.reading.grey));
    for (const GreyReading& r : kReportTable)
        svg += fmt::format("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"6\" height=\"6\" fill=\"#c60\"/>\n",
                           plot_x(r.per_s) - 3, plot_y(r.grey) - 3);
    const char* legend[] = {"measured, and 255 (1 - exp(-k x)) through it",
                            "the report's table, one parameter", "the report's fit (dashed), clamped"};
    const char* colours[] = {"#06c", "#c60", "#c60"};
    for (int i = 0; i < 3; ++i)
        svg += fmt::format("<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n", kLeft + 12, kTop + 20 + 16 * i,
                           colours[i], legend[i]);
    return svg + "</svg>\n";
}

}  // namespace spindrift::app
