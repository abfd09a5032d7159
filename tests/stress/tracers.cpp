// SPDX-License-Identifier: MIT
#include "tests/stress/tracers.h"

#include <algorithm>
#include <cmath>

#include "core/snow.h"
#include "core/turbulence.h"

namespace spindrift::stress
{

namespace
{

/// So little snowfall that every flake has the smallest size.
Snow even_snow()
{
    Snow snow;
    snow.rate_mm_h = 1e-3F;
    snow.crystal = Crystal::plates;
    snow.fall_speed_spread_m_s = 0;
    return snow;
}

}  // namespace

World tracer_world(std::uint64_t flakes, Vec3f size_m, double step_s)
{
    World w;
    w.size_m = size_m;
    w.on_leave = OnLeave::wrap;
    w.has_ground = false;
    w.capacity = flakes;
    w.step_s = step_s;
    w.snow = even_snow();
    w.seed = 1000003;  // the id that equals it has the largest flake
    Emitter e;
    e.shape = EmitterShape::box;
    e.b = size_m;
    e.burst = flakes;
    w.emitters.push_back(e);
    return w;
}

float fall_speed()
{
    return FallSpeed(even_snow(), 1).at<float>(0U);
}

Wind even_air(const Stress<double>& stress, double c0_eps)
{
    const StressRoot<double> s = stress_root(realizable(stress));
    const auto f = [](double v) { return static_cast<float>(v); };
    return cpu::test::grid_wind(1, 1, 1, {0, 0, 0}, {1, 1, 1},
                                [&](float, float, float)
                                {
                                    WindCell c{};
                                    c.w = fall_speed();
                                    c.s11 = f(s.s11), c.s21 = f(s.s21), c.s22 = f(s.s22);
                                    c.s31 = f(s.s31), c.s32 = f(s.s32), c.s33 = f(s.s33);
                                    c.c0_eps = f(c0_eps);
                                    return c;
                                });
}

std::vector<std::size_t> living(const TestRun& run)
{
    std::vector<std::size_t> slots;
    for (std::size_t i = 0; i < run.backend->slots_used(); ++i)
        if ((run.flakes.state[i] & 0xFFU) == 0) slots.push_back(i);
    return slots;
}

void Bins::add(double share, double u, double w)
{
    const double at =
        std::clamp(share * static_cast<double>(count_.size()), 0.0, static_cast<double>(count_.size()) - 0.5);
    const auto bin = static_cast<std::size_t>(at);
    count_[bin] += 1, square_[bin] += u * u, product_[bin] += u * w;
    total_ += 1;
}

double Bins::entropy() const
{
    double sum = 0;
    for (const double n : count_)
    {
        const double p = n * static_cast<double>(count_.size()) / total_;
        if (p > 0) sum += p * std::log(p);
    }
    return sum;
}

double Bins::entropy_mark() const
{
    const auto b = static_cast<double>(count_.size());
    return (b * (b - 1) + 5 * b * std::sqrt(2 * (b - 1))) / (2 * total_);
}

double Bins::chi_square() const
{
    const double expected = total_ / static_cast<double>(count_.size());
    double sum = 0;
    for (const double n : count_) sum += (n - expected) * (n - expected) / expected;
    return sum;
}

double Bins::chi_square_mark() const
{
    const auto freedom = static_cast<double>(count_.size() - 1);
    return freedom + 5 * std::sqrt(2 * freedom);
}

double Bins::variance_error() const
{
    double sum = 0;
    for (std::size_t b = 0; b < count_.size(); ++b)
        sum += (square_[b] / count_[b] - 1) * (square_[b] / count_[b] - 1);
    return std::sqrt(sum / static_cast<double>(count_.size()));
}

double Bins::variance_mark() const
{
    return 1.6 * std::sqrt(2 * static_cast<double>(count_.size()) / total_);
}

}  // namespace spindrift::stress
