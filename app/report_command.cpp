// SPDX-License-Identifier: MIT
#include <cstdio>
#include <span>

#include <fmt/format.h>

#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/machine.h"
#include "app/report_page.h"
#include "core/error.h"
#include "image/whole_file.h"

namespace spindrift::app
{

namespace
{

constexpr double kSeconds = 12;  ///< simulated: some ten times the longest T

/// A line on stderr that says how far the measurements are.
void show(std::size_t done, std::size_t all, const std::string& what)
{
    fmt::print(stderr, "{} of {}: {}\n", done + 1, all, what);
}

}  // namespace

int report(const ReportOptions& options)
{
    const image::AsideFile probe(options.out);  // before minutes of work
    Study study;
    study.flakes = options.particles;
    study.seconds = kSeconds;
    study.machine =
        fmt::format("{}; one thread for advection, {} for the solver.", processor_name(), usable_threads({}));
    const auto settings = validation::advection_sweep();
    const auto solves = validation::solver_sweep(options.most_cells);
    const std::size_t all = settings.size() + solves.size();
    for (const validation::AdvectionSetting& setting : settings)
    {
        show(study.advection.size(), all, setting.name());
        study.advection.push_back(validation::measure_advection(setting, options.particles, kSeconds));
    }
    for (const validation::SolverSetting& setting : solves)
    {
        show(settings.size() + study.solver.size(), all,
             fmt::format("solver, {} cells, {:g}", setting.cells, setting.tolerance));
        study.solver.push_back(validation::measure_solver(setting, 0));
    }
    validation::mark_frontier(study.advection);
    validation::mark_frontier(study.solver);
    const std::string page = report_page(study);
    image::write_whole(options.out, std::as_bytes(std::span(page)));
    fmt::print("wrote {}\n", options.out.string());
    return kOk;
}

}  // namespace spindrift::app
