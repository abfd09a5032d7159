// SPDX-License-Identifier: MIT
// Flakes that fall through turbulence between two walls that let nothing through: Rouse's profile, and the
// exponential one of a diffusivity that does not change with height. Docs: docs/validation.md.
#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "validation/all_cases.h"
#include "validation/worlds.h"

namespace spindrift::validation
{

namespace
{

constexpr double kTop = 5, kFall = 0.3;  // m, m/s
/// Large, so that the turbulence's length sigma T is a small part of the height: the flakes remember the
/// walls for some of these lengths, and the profiles do not.
constexpr double kSigma = 2;  // m/s
/// Some times of the slowest, (height / kappa u*) at u* = 0.4 m/s.
constexpr double kSettled_s = 60;
constexpr double kOrigin = 0.3;  ///< height of the lower wall above that at which K vanishes, m

World falling_world(const Settings& settings, double dt, double friction_m_s, double constant_k)
{
    constexpr double kCell = 0.02;
    World w = empty_world(settings, dt, {100, 100, static_cast<float>(kTop)});
    w.snow.fall_speed_m_s = static_cast<float>(kFall);
    w.wind = wind_along(Along::z, 0, kCell, static_cast<int>(kTop / kCell),
                        [&](double z)
                        {
                            const double k =
                                constant_k > 0 ? constant_k : kVonKarman * friction_m_s * (z + kOrigin);
                            return isotropic(kSigma, kSigma * kSigma / k);
                        });
    add_ground(w);
    add_lid(w, static_cast<float>(kTop), static_cast<float>(kTop));
    add_burst(w, {0, 0, 0}, {100, 100, static_cast<float>(kTop)});
    return w;
}

/// Counts in bins of equal ratio of z + origin from low to high, summed over looks, by batches of flakes,
/// which know nothing of each other.
class Profile
{
  public:
    Profile(double low, double high, double origin, bool over_logarithm)
        : low_(low), high_(high), origin_(origin), over_logarithm_(over_logarithm)
    {
    }

    void look(const FlakeRun& run)
    {
        for (std::size_t i = 0; i < run.slots(); ++i)
        {
            const double z = static_cast<double>(run.flakes().z[i]) + origin_;
            if (!run.alive(i) || z < low_ || z >= high_) continue;
            const double at = kBins * std::log(z / low_) / std::log(high_ / low_);
            ++count_[run.flakes().id[i] % kBatches]
                    [static_cast<std::size_t>(std::clamp(at, 0.0, kBins - 1.0))];
        }
    }

    /// Slope of ln C over ln z or z: mean over the batches and its standard deviation.
    std::pair<double, double> slope() const
    {
        double sum = 0, squares = 0;
        for (const Counts& count : count_)
        {
            const double s = slope(count);
            sum += s, squares += s * s;
        }
        constexpr double n = kBatches;
        const double mean = sum / n;
        return {mean, std::sqrt(std::max(0.0, squares / n - mean * mean) / (n - 1))};
    }

  private:
    static constexpr int kBins = 10;
    static constexpr std::size_t kBatches = 20;
    using Counts = std::array<double, kBins>;

    double edge(int b) const { return low_ * std::pow(high_ / low_, static_cast<double>(b) / kBins); }

    /// Least squares, weighted with the counts.
    double slope(const Counts& count) const
    {
        double w = 0, wx = 0, wy = 0, wxx = 0, wxy = 0;
        for (int b = 0; b < kBins; ++b)
        {
            const double n = count[static_cast<std::size_t>(b)], low = edge(b), high = edge(b + 1);
            if (n < 1) continue;
            const double x = over_logarithm_ ? 0.5 * std::log(low * high) : 0.5 * (low + high);
            const double y = std::log(n / (high - low));
            w += n, wx += n * x, wy += n * y, wxx += n * x * x, wxy += n * x * y;
        }
        return (w * wxy - wx * wy) / (w * wxx - wx * wx);
    }

    double low_, high_, origin_;
    bool over_logarithm_;
    std::array<Counts, kBatches> count_{};
};

void check_profile(const Settings& settings, double dt, double friction_m_s, double constant_k,
                   Outcome& outcome)
{
    const bool rouse = constant_k <= 0;
    const World world = falling_world(settings, dt, friction_m_s, constant_k);
    FlakeRun run(world, settings);
    const auto steps = [&](double seconds) { run.steps(static_cast<std::uint64_t>(seconds / dt)); };
    steps(kSettled_s);
    Profile profile = rouse ? Profile(0.5, 3.5, kOrigin, true) : Profile(0.5, 4, 0, false);
    for (int look = 0; look < 10; ++look)
    {
        steps(1);
        profile.look(run);
    }
    const auto [measured, noise] = profile.slope();
    const double truth = rouse ? -kFall / (kVonKarman * friction_m_s) : -kFall / constant_k;
    const std::string which = rouse ? fmt::format("dt = {:g} s, u* = {:g} m/s: ", dt, friction_m_s)
                                    : fmt::format("dt = {:g} s, K = {:g} m2/s: ", dt, constant_k);
    // bins as wide as a fifth of their height bend the slope by less than 1 %
    outcome.checks.push_back(sampled(which + (rouse ? "exponent of C(z)" : "slope of ln C(z), 1/m"), measured,
                                     truth, noise, 4, 0.01 * std::abs(truth)));
    const auto lost = static_cast<double>(settings.particles - run.backend().counts().alive);
    outcome.checks.push_back({which + "rogue or lost", static_cast<double>(run.rogue()) + lost, 0, 0, 0});
}

}  // namespace

Outcome validate_rouse(const Settings& settings)
{
    Outcome outcome;
    for (const double dt : settings.dt_s)
    {
        for (const double friction : {0.4, 0.6, 1.0}) check_profile(settings, dt, friction, 0, outcome);
        check_profile(settings, dt, 0, 0.6, outcome);
    }
    return outcome;
}

}  // namespace spindrift::validation
