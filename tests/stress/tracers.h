// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "core/turbulence.h"
#include "core/world.h"
#include "tests/cpu/worlds.h"

namespace spindrift::stress
{

using cpu::test::TestRun;

/// An empty world in which all flakes fall at one speed, so that an updraft of fall_speed() makes tracers of
/// them. One emitter: a box, the whole domain.
World tracer_world(std::uint64_t flakes, Vec3f size_m, double step_s);

/// Terminal speed of every flake of a tracer_world, m/s.
float fall_speed();

/// One wind cell everywhere: the root of a stress, and C0 eps; with the updraft.
Wind even_air(const Stress<double>& stress, double c0_eps);

/// Slots of the flakes that live.
std::vector<std::size_t> living(const TestRun& run);

/// Counts in bins of equal expectation.
class Bins
{
  public:
    explicit Bins(std::size_t bins) : count_(bins), square_(bins), product_(bins) {}

    /// `share` in [0, 1): where; u, w: what is averaged there.
    void add(double share, double u = 0, double w = 0);

    /// Sum of p ln p, p the count over its expectation.
    double entropy() const;
    /// Its noise, mean and five standard deviations: B (B - 1) / 2N + 5 B sqrt(2 (B - 1)) / 2N.
    double entropy_mark() const;
    double chi_square() const;
    /// Five standard deviations above the mean of chi-square with B - 1 degrees of freedom.
    double chi_square_mark() const;
    /// Root mean square over the bins of (mean of u^2) - 1.
    double variance_error() const;
    /// 1.6 times its noise sqrt(2 B / N).
    double variance_mark() const;
    double mean_product(std::size_t bin) const { return product_[bin] / count_[bin]; }
    double count(std::size_t bin) const { return count_[bin]; }
    std::size_t size() const { return count_.size(); }

  private:
    std::vector<double> count_, square_, product_;
    double total_ = 0;
};

}  // namespace spindrift::stress
