// SPDX-License-Identifier: MIT
// Homogeneous turbulence: what the Langevin step makes of the Ornstein-Uhlenbeck process, whose moments and
// spread are known in closed form. Docs: docs/validation.md.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <fmt/format.h>

#include "validation/homogeneous.h"
#include "validation/worlds.h"

namespace spindrift::validation
{

double taylor_spread(double times)
{
    return 2 * (times + std::expm1(-times));
}

namespace
{

constexpr double kTime_s = 0.01;  ///< T; relaxation rates end at 1 / 1 ms

/// Flakes from one point in air of one sigma; spread over three axes.
class Puff
{
  public:
    Puff(const Settings& settings, double sigma_m_s, double per_step, double step_s)
        : n_(static_cast<double>(settings.particles)),
          run_(world(settings, sigma_m_s, per_step, step_s), settings)
    {
    }

    void steps(std::uint64_t n) { run_.steps(n); }
    const FlakeRun& run() const { return run_; }

    /// Mean square of the distance from the start along one axis, m2.
    double spread() const
    {
        const FlakeView& f = run_.flakes();
        double sum = 0;
        for (const float* x : {f.x, f.y, f.z})
            for (std::size_t i = 0; i < run_.slots(); ++i)
            {
                const double d = static_cast<double>(x[i]) - middle_;
                sum += d * d;
            }
        return sum / (3 * n_);
    }

    /// Of the whitened velocities; 1 is the truth.
    double variance() const { return correlation(velocities()); }

    std::vector<float> velocities() const
    {
        const FlakeView& f = run_.flakes();
        std::vector<float> q;
        for (const float* from : {f.q1, f.q2, f.q3}) q.insert(q.end(), from, from + run_.slots());
        return q;
    }

    /// With velocities of another time.
    double correlation(const std::vector<float>& before) const
    {
        const std::vector<float> now = velocities();
        double sum = 0;
        for (std::size_t i = 0; i < now.size(); ++i)
            sum += static_cast<double>(now[i]) * static_cast<double>(before[i]);
        return sum / (3 * n_);
    }

  private:
    World world(const Settings& settings, double sigma_m_s, double per_step, double step_s)
    {
        const double rate = per_step / step_s;
        // forty standard deviations of the longest runs here; a float keeps 1e-7 of it
        const double steps = 3000, size = 40 * sigma_m_s * step_s * (std::sqrt(2 * steps / per_step) + 1);
        const auto edge = static_cast<float>(size);
        middle_ = static_cast<double>(0.5F * edge);
        World w = empty_world(settings, step_s, {edge, edge, edge});
        w.on_leave = OnLeave::remove;
        w.wind = wind_everywhere(isotropic(sigma_m_s, rate));
        add_burst(w, {0.5F * edge, 0.5F * edge, 0.5F * edge}, {0.5F * edge, 0.5F * edge, 0.5F * edge});
        return w;
    }

    double n_, middle_ = 0;
    FlakeRun run_;
};

/// One a = dt / T: variance of q, its correlation over T, spread after Taylor, diffusivity.
void check_step_length(const Settings& settings, double a, double sigma, std::vector<Check>& checks)
{
    // noise of a mean square over 3 N numbers; of the difference of two spreads, the second twice the first
    const double n = 3 * static_cast<double>(settings.particles);
    const double square = std::sqrt(2 / n), difference = std::sqrt(6 / n);
    const std::string which = fmt::format("a = {:g}, sigma = {:g} m/s: ", a, sigma);
    Puff puff(settings, sigma, a, a * kTime_s);
    puff.steps(1);
    const std::vector<float> first = puff.velocities();
    std::uint64_t done = 1;
    if (a <= 0.1)
    {
        const auto over = static_cast<std::uint64_t>(std::lround(1 / a));
        puff.steps(over);
        done += over;
        // variance of the product of two correlated Gaussians
        const double truth = std::exp(-1.0);
        checks.push_back(sampled(which + "correlation over T", puff.correlation(first), truth,
                                 std::sqrt((1 + truth * truth) / n), 4, a * a / 12));
    }
    const std::uint64_t half = std::max<std::uint64_t>(done, a <= 2 ? 1000 : 1500);
    puff.steps(half - done);
    const double times = static_cast<double>(half) * a, unit = sigma * kTime_s;  // t / T, sigma T
    const double spread_half = puff.spread();
    if (a <= 0.1)
        checks.push_back(sampled(which + fmt::format("spread over Taylor's at t = {:g} T", times),
                                 spread_half / (unit * unit * taylor_spread(times)), 1, square, 4, a * a));
    puff.steps(half);
    checks.push_back(sampled(which + "variance of q", puff.variance(), 1, square, 4));
    if (a >= 0.01)
    {
        const double k = (puff.spread() - spread_half) / (2 * times * unit * unit);
        // what is left of the transient: (1 - a^2 / 4) (r^n - r^2n) T / t
        const double r = std::abs((1 - a / 2) / (1 + a / 2));
        const double transient = std::abs(1 - a * a / 4) * std::pow(r, static_cast<double>(half)) / times;
        checks.push_back(sampled(which + "K over sigma^2 T", k, 1, difference, 4, transient));
    }
    checks.push_back({which + "rogue", static_cast<double>(puff.run().rogue()), 0, 0, 0});
}

}  // namespace

Outcome validate_ornstein_uhlenbeck(const Settings& settings)
{
    Outcome outcome;
    for (const double a : {1e-3, 1e-2, 0.1, 0.5, 1.0, 2.0, 5.0, 20.0, 100.0, 1000.0})
        check_step_length(settings, a, 0.7, outcome.checks);
    for (const double sigma : {1e-4, 1e-2, 10.0}) check_step_length(settings, 0.1, sigma, outcome.checks);
    return outcome;
}

Outcome validate_taylor(const Settings& settings)
{
    Outcome outcome;
    constexpr double kSigma = 0.5, kLonger_s = 2;  // m/s; T in s
    const double noise = std::sqrt(2 / (3 * static_cast<double>(settings.particles)));
    for (const double dt : settings.dt_s)
    {
        const double a = dt / kLonger_s;
        Puff puff(settings, kSigma, a, dt);
        std::uint64_t done = 0;
        for (const double times : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0})
        {
            const auto n = static_cast<std::uint64_t>(std::llround(times / a));
            if (n <= done) continue;  // the step is too long to stop there
            puff.steps(n - done);
            done = n;
            const double at = static_cast<double>(n) * a;
            const double unit = kSigma * kLonger_s;
            // Cayley's spread after n steps differs from Taylor's by a^2 (1 / n^2 ... 1 / 4)
            outcome.checks.push_back(
                sampled(fmt::format("dt = {:g} T: spread over (sigma T)^2 at t = {:g} T", a, at),
                        puff.spread() / (unit * unit), taylor_spread(at), noise * taylor_spread(at), 3));
        }
        outcome.checks.push_back(
            {fmt::format("dt = {:g} T: rogue", a), static_cast<double>(puff.run().rogue()), 0, 0, 0});
    }
    return outcome;
}

}  // namespace spindrift::validation
