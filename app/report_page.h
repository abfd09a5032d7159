// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "validation/study.h"

namespace spindrift::app
{

/// What a report is made of; frontiers are marked.
struct Study
{
    std::string machine;
    std::uint64_t flakes = 0;
    double seconds = 0;  ///< simulated in each run of advection
    std::vector<validation::AdvectionPoint> advection;
    std::vector<validation::SolverPoint> solver;
};

/// One HTML page with its curves as SVG; refers to nothing outside itself.
std::string report_page(const Study& study);

}  // namespace spindrift::app
