// SPDX-License-Identifier: MIT
#include "app/report_page.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

#include <fmt/format.h>

namespace spindrift::app
{

namespace
{

using validation::AdvectionPoint;
using validation::SolverPoint;

struct Mark
{
    double x, y;
    std::string about;
    bool on_frontier = false, is_default = false;
};

struct Curve
{
    std::string name, colour;
    std::vector<Mark> marks;
    bool line = true;
};

constexpr const char* kColours[] = {"#1f6fb4", "#7fb2de", "#d1495b", "#8d5a97", "#e09f3e", "#3a7d44"};

std::string escaped(const std::string& text)
{
    std::string out;
    for (const char c : text)
        out += c == '<'   ? "&lt;"
               : c == '>' ? "&gt;"
               : c == '&' ? "&amp;"
               : c == '"' ? "&quot;"
                          : std::string(1, c);
    return out;
}

/// Both axes logarithmic, from decade to decade.
class Chart
{
  public:
    Chart(std::string id, std::string x_label, std::string y_label, const std::vector<Curve>& curves)
        : id_(std::move(id)), x_label_(std::move(x_label)), y_label_(std::move(y_label)), curves_(curves)
    {
        for (const Curve& curve : curves)
            for (const Mark& mark : curve.marks)
            {
                x_.include(mark.x);
                y_.include(mark.y);
            }
    }

    void level(double y, const std::string& name) { level_ = y, level_name_ = name, y_.include(y); }

    std::string svg() const
    {
        std::string out = fmt::format(
            "<svg id=\"{}\" viewBox=\"0 0 {} {}\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\">\n", id_,
            kWidth, kHeight);
        out += axes();
        if (level_ > 0)
            out += fmt::format(
                "<line class=\"noise\" x1=\"{}\" x2=\"{}\" y1=\"{:.1f}\" y2=\"{:.1f}\"/><text x=\"{}\" "
                "y=\"{:.1f}\">{}</text>\n",
                kLeft, kWidth - kRight, at_y(level_), at_y(level_), kLeft + 6, at_y(level_) - 4,
                escaped(level_name_));
        int row = 0;
        for (const Curve& curve : curves_) out += drawn(curve, row++);
        return out + "</svg>\n";
    }

  private:
    static constexpr int kWidth = 860, kHeight = 440, kLeft = 70, kRight = 230, kTop = 16, kBottom = 52;

    struct Span
    {
        double low = 1e300, high = 1e-300;
        void include(double v)
        {
            if (!(v > 0)) return;
            low = std::min(low, v), high = std::max(high, v);
        }
        double first() const { return std::floor(std::log10(low)); }
        double last() const { return std::max(std::ceil(std::log10(high)), first() + 1); }
    };

    double at_x(double v) const
    {
        return kLeft + (std::log10(v) - x_.first()) / (x_.last() - x_.first()) * (kWidth - kLeft - kRight);
    }
    double at_y(double v) const
    {
        return kHeight - kBottom -
               (std::log10(v) - y_.first()) / (y_.last() - y_.first()) * (kHeight - kTop - kBottom);
    }

    std::string axes() const
    {
        std::string out;
        for (double d = x_.first(); d <= x_.last(); ++d)
            out += fmt::format(
                "<line class=\"grid\" x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/><text "
                "x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">{4:g}</text>\n",
                at_x(std::pow(10, d)), kTop, kHeight - kBottom, kHeight - kBottom + 16, std::pow(10, d));
        for (double d = y_.first(); d <= y_.last(); ++d)
            out += fmt::format(
                "<line class=\"grid\" x1=\"{1}\" x2=\"{2}\" y1=\"{0:.1f}\" y2=\"{0:.1f}\"/><text x=\"{3}\" "
                "y=\"{4:.1f}\" text-anchor=\"end\">{5:g}</text>\n",
                at_y(std::pow(10, d)), kLeft, kWidth - kRight, kLeft - 6, at_y(std::pow(10, d)) + 4,
                std::pow(10, d));
        out += fmt::format("<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">{}</text>\n",
                           (kLeft + kWidth - kRight) / 2, kHeight - 14, escaped(x_label_));
        out +=
            fmt::format("<text transform=\"translate(16 {}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                        (kTop + kHeight - kBottom) / 2, escaped(y_label_));
        return out;
    }

    std::string drawn(const Curve& curve, int row) const
    {
        std::string out, line;
        for (const Mark& m : curve.marks) line += fmt::format("{:.1f},{:.1f} ", at_x(m.x), at_y(m.y));
        if (curve.line)
            out += fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n",
                               line, curve.colour);
        for (const Mark& m : curve.marks)
        {
            if (m.on_frontier)
                out += fmt::format("<circle class=\"frontier\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"8\"/>",
                                   at_x(m.x), at_y(m.y));
            out += fmt::format(
                "<circle {}cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"><title>{}</title></circle>\n",
                m.is_default ? "class=\"default\" " : "", at_x(m.x), at_y(m.y), m.is_default ? 6 : 4,
                curve.colour, escaped(m.about));
            if (m.is_default)
                out += fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\">default</text>\n", at_x(m.x) + 10,
                                   at_y(m.y) + 14);
        }
        const int y = kTop + 14 + 20 * row;
        out += fmt::format(
            "<circle cx=\"{}\" cy=\"{}\" r=\"4\" fill=\"{}\"/><text x=\"{}\" y=\"{}\">{}</text>\n",
            kWidth - kRight + 16, y - 4, curve.colour, kWidth - kRight + 26, y, escaped(curve.name));
        return out;
    }

    std::string id_, x_label_, y_label_;
    const std::vector<Curve>& curves_;
    Span x_, y_;
    double level_ = 0;
    std::string level_name_;
};

std::string about(const AdvectionPoint& p)
{
    return fmt::format("{}: {:.0f} ns a flake and second, error {:.3g}", p.setting.name(),
                       p.ns_per_flake_second, p.error);
}

/// The points in groups, each a curve, in the order in which they come.
template <class Point>
std::vector<Curve> curves(const std::vector<Point>& points,
                          const std::function<std::string(const Point&)>& group,
                          const std::function<Mark(const Point&)>& mark)
{
    std::vector<Curve> result;
    for (const Point& p : points)
    {
        const std::string name = group(p);
        if (name.empty()) continue;
        auto found =
            std::find_if(result.begin(), result.end(), [&](const Curve& c) { return c.name == name; });
        if (found == result.end())
        {
            result.push_back({name, kColours[result.size() % std::size(kColours)], {}});
            found = result.end() - 1;
        }
        found->marks.push_back(mark(p));
    }
    return result;
}

std::string integrator_group(const AdvectionPoint& p)
{
    const validation::AdvectionSetting& s = p.setting;
    if (s.precision != "float" || s.sampling != "trilinear") return "";
    if (s.integrator != "ours") return s.integrator + ", one by one";
    if (s.code == "one-by-one") return "ours, one by one";
    return "ours, SIMD";
}

std::string advection_section(const Study& study)
{
    const auto by_time = [](const AdvectionPoint& p) {
        return Mark{p.ns_per_flake_second, p.error, about(p), p.on_frontier, p.setting.is_default};
    };
    const auto by_step = [](const AdvectionPoint& p) {
        return Mark{p.setting.dt_s, p.error, about(p), false, p.setting.is_default};
    };
    const std::vector<Curve> time = curves<AdvectionPoint>(study.advection, integrator_group, by_time);
    const std::vector<Curve> step = curves<AdvectionPoint>(study.advection, integrator_group, by_step);
    const double noise = study.advection.empty() ? 0 : study.advection.front().noise;
    Chart against_time("advection-time", "ns of one thread for a flake and a simulated second",
                       "error of density and velocity variance", time);
    against_time.level(noise, "sampling noise");
    Chart against_step("advection-step", "time step, s", "error of density and velocity variance", step);
    against_step.level(noise, "sampling noise");
    std::string out = fmt::format(
        "<h2>Advection</h2>\n<p>Well-mixed sinusoid: &sigma;&sup2; = 1.1 + sin 2&pi;x, "
        "C<sub>0</sub>&epsilon; = "
        "4&sigma;&sup3;, {:g} s, {} flakes. Error: root of the mean squares of (density - 1) and (var q - 1) "
        "over 25 bins. "
        "Rings: the frontier. Nobody there is beaten by one who is faster and, beyond chance, more accurate, "
        "or faster, as accurate and of steps that are no longer.</p>\n",
        study.seconds, study.flakes);
    out += against_time.svg() + against_step.svg();
    const double dt = validation::equal_error_at_ten_times(study.advection);
    if (dt > 0)
        out += fmt::format(
            "<p id=\"ten-times\">At dt = {:g} s our step has an error no larger than Bailey's at {:g} s, a "
            "tenth of it.</p>\n",
            dt, dt / 10);
    const auto field_group = [](const AdvectionPoint& p)
    {
        return p.path_error_m < 0 || p.setting.code == "packs"
                   ? ""
                   : p.setting.precision + ", " + p.setting.sampling;
    };
    const auto path = [](const AdvectionPoint& p) {
        return Mark{p.ns_per_flake_second, p.path_error_m, about(p), false, false};
    };
    const std::vector<Curve> field = curves<AdvectionPoint>(study.advection, field_group, path);
    out +=
        "<h3>Precision and sampling of the field</h3>\n<p>Ours, one flake at a time: distance to the same "
        "walk in "
        "double precision after a second.</p>\n";
    return out + Chart("advection-field", "ns of one thread for a flake and a simulated second",
                       "distance to the walk in double, m", field)
                     .svg();
}

std::string solver_section(const Study& study)
{
    const std::vector<Curve> by_cells = curves<SolverPoint>(
        study.solver, [](const SolverPoint& p) { return fmt::format("{} cells along an edge", p.cells); },
        [](const SolverPoint& p)
        {
            return Mark{
                p.ms, p.error,
                fmt::format("{} cells, relative residual {:g}: {:.2f} ms, error {:.3g}, {} iterations",
                            p.cells, p.tolerance, p.ms, p.error, p.iterations),
                p.on_frontier, p.is_default};
        });
    return "<h2>Solver of the wind</h2>\n<p>Manufactured field on n x (n+1) x (n-1) cells, solved to a "
           "relative residual of 1e-1 to "
           "1e-8. Error: root mean square against the truth.</p>\n" +
           Chart("solver", "ms", "error", by_cells).svg();
}

std::string table(const Study& study)
{
    std::string out =
        "<h2>All points</h2>\n<table><tr><th>setting</th><th>ns a flake and "
        "second</th><th>error</th><th>noise</th><th>distance to "
        "double, m</th><th>ran away</th><th>frontier</th></tr>\n";
    for (const AdvectionPoint& p : study.advection)
        out += fmt::format(
            "<tr{}><td>{}{}</td><td>{:.0f}</td><td>{:.4f}</td><td>{:.4f}</td><td>{}</td><td>{:.1f} "
            "%</td><td>{}</td></tr>\n",
            p.setting.is_default ? " class=\"default\"" : "", escaped(p.setting.name()),
            p.setting.is_default ? " (default)" : "", p.ns_per_flake_second, p.error, p.noise,
            p.path_error_m >= 0 ? fmt::format("{:.1e}", p.path_error_m) : "", 100 * p.rogue_share,
            p.on_frontier ? "yes" : "");
    return out + "</table>\n";
}

constexpr const char* kStyle = R"(
body { font: 15px/1.5 sans-serif; color: #222; max-width: 880px; margin: 2em auto; padding: 0 1em; }
svg { width: 100%; height: auto; } svg text { font: 12px sans-serif; fill: #333; }
.grid { stroke: #ddd; } .noise { stroke: #888; stroke-dasharray: 5 4; }
.frontier { fill: none; stroke: #222; stroke-width: 1.2; } circle.default { stroke: #222; stroke-width: 2; }
table { border-collapse: collapse; font-size: 13px; } td, th { padding: 2px 8px; border-bottom: 1px solid #ddd; text-align: right; }
td:first-child, th:first-child { text-align: left; } tr.default { font-weight: bold; }
)";

}  // namespace

std::string report_page(const Study& study)
{
    return fmt::format(
        "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>Spindrift: time against "
        "error</title><style>{}</style></head><body>\n<h1>Time against "
        "error</h1>\n<p>{}</p>\n{}{}{}</body></html>\n",
        kStyle, escaped(study.machine), advection_section(study), solver_section(study), table(study));
}

}  // namespace spindrift::app
