// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "validation/worlds.h"

namespace spindrift::validation
{

/// An air volume across the wind, as wide as the plume: its concentration per rate of the source, C_y / Q in
/// s/m2, is the mean time that a flake spends in it, over its length and height.
struct Sampler
{
    double x_m, z_m;  ///< middle
    double length_m, height_m;
};

struct Reading
{
    double value = 0;  ///< s/m2
    double noise = 0;  ///< one standard deviation of it
};

/// Times that the flakes of a burst spend in samplers. A burst summed over time is a steady plume summed over
/// its sources. Noise comes from batches of flakes, by id.
class ResidenceMeter
{
  public:
    explicit ResidenceMeter(std::vector<Sampler> samplers);
    void look(const FlakeRun& run, double step_s);
    std::vector<Reading> readings(std::uint64_t flakes) const;

  private:
    static constexpr std::size_t kBatches = 32;
    std::vector<Sampler> samplers_;
    std::vector<double> time_s_;  ///< by sampler and batch
};

}  // namespace spindrift::validation
