// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace spindrift::validation
{

// Time against error: advection in the well-mixed sinusoid, and the solver on a manufactured field. For the
// benchmark's rows (accuracy/) and the report.

/// How advection is done.
struct AdvectionSetting
{
    std::string integrator;              ///< ours, explicit-euler, bailey, exact-ou-sum
    std::string precision = "float";     ///< of the field: float, half
    std::string sampling = "trilinear";  ///< or nearest
    std::string code = "one-by-one";     ///< one flake at a time, as all rivals; packs: the backend's widest
    double dt_s = 0.1;
    bool is_default = false;  ///< what a scene gets that says nothing

    std::string name() const;
};

struct AdvectionPoint
{
    AdvectionSetting setting;
    double ns_per_flake_second = 0;  ///< one thread
    double error = 0;  ///< root of the mean squares of (density - 1) and (var q - 1) over 25 bins
    double noise = 0;  ///< what sampling alone makes of that
    double path_error_m =
        -1;  ///< root mean square distance to the same walk in double after 1 s; < 0: not asked
    double rogue_share = 0;
    bool on_frontier = false;

    /// Chance alone would not do this in a thousand runs.
    bool above_noise() const { return error > 1.33 * noise; }
};

struct SolverPoint
{
    int cells = 0;  ///< along an edge
    double tolerance = 0;
    double ms = 0;
    double error = 0;  ///< root mean square against the manufactured truth
    int iterations = 0;
    bool on_frontier = false;
    bool is_default = false;  ///< the tolerance of scenes
};

/// All settings of the sweep; those that differ in the time step alone lie together.
std::vector<AdvectionSetting> advection_sweep();
AdvectionPoint measure_advection(const AdvectionSetting& setting, std::uint64_t flakes, double seconds);

struct SolverSetting
{
    int cells;
    double tolerance;
};
/// Grids of at most so many cells along an edge.
std::vector<SolverSetting> solver_sweep(int most_cells);
SolverPoint measure_solver(const SolverSetting& setting, int threads);

/// Marks the points that no other beats. To beat a point is to be faster, and more accurate by more than
/// chance; or faster, not less accurate beyond chance, with steps that are no longer: a step is also how
/// often places are known.
void mark_frontier(std::vector<AdvectionPoint>& points);
/// Nobody is both faster and more accurate.
void mark_frontier(std::vector<SolverPoint>& points);

/// The longest time step at which ours is no less accurate, beyond chance, than Bailey's implicit step at a
/// tenth of it; 0: there is none among the points.
double equal_error_at_ten_times(const std::vector<AdvectionPoint>& points);

}  // namespace spindrift::validation
