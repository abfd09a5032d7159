// SPDX-License-Identifier: MIT
#include "validation/study.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <tbb/task_arena.h>

#include "core/error.h"
#include "core/gradient_reach.h"
#include "cpu/poisson_solver.h"
#include "validation/manufactured.h"
#include "validation/study_kernels.h"
#include "validation/well_mixed.h"

namespace spindrift::validation
{

namespace
{

using Clock = std::chrono::steady_clock;

double ms_since(Clock::time_point start)
{
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

/// The sinusoid's stress, its divergence and C0 eps, on the cells of its grid.
std::vector<float> rival_numbers(const Wind& wind)
{
    std::vector<float> numbers(wind.cells.size() * 16, 0);
    const auto f = [](double v) { return static_cast<float>(v); };
    for (std::size_t i = 0; i < wind.cells.size(); ++i)
    {
        const double x = static_cast<double>(wind.origin_m.x) +
                         static_cast<double>(wind.cell_m.x) * static_cast<double>(i);
        const double phase = 2 * std::numbers::pi * x, variance = 1.1 + std::sin(phase);
        float* n = numbers.data() + 16 * i;
        n[4] = f(variance), n[7] = n[9] = 1;
        n[10] = f(2 * std::numbers::pi * std::cos(phase));
        n[13] = f(4 * std::pow(variance, 1.5));
    }
    return numbers;
}

/// Of the cells as the backend holds them.
std::vector<float> own_numbers(const World& world)
{
    std::vector<WindCell> cells = world.wind.cells;
    spread_gradients(cells.data(), world.wind.nx, world.wind.ny, world.wind.nz, world.wind.cell_m,
                     world.step_s / relaxations(world));
    const float* first = &cells.front().u;
    return {first, first + 16 * cells.size()};
}

std::vector<std::uint16_t> halved(const std::vector<float>& numbers)
{
    std::vector<std::uint16_t> half;
    for (const float v : numbers) half.push_back(cpu::to_half(v));
    return half;
}

/// A run of one setting on one thread.
class Walk
{
  public:
    Walk(const AdvectionSetting& setting, std::uint64_t flakes)
        : setting_(setting),
          settings_(one_thread(flakes)),
          world_(sinusoid_world(settings_, setting.dt_s)),
          run_(world_, settings_, options(setting))
    {
        run_.step();  // emission, and the first step of ours; for the others a slightly later start
        job_ = advect_job(world_, world_.wind.cells.data(), solids_view(world_));
        job_.step.relaxations = relaxations(world_);
        job_.flakes = run_.flakes();
        region_ = {{0, 0, 0}, world_.size_m, false};
        job_.around.regions = &region_;
        own_ = own_numbers(world_);
        half_ = halved(own_);
        if (rival())
        {
            rival_ = rival_numbers(world_.wind);
            to_velocities();
        }
    }

    void step()
    {
        ++number_;
        job_.step.number = number_;
        if (rival())
        {
            const Rival which = setting_.integrator == "bailey"           ? Rival::bailey
                                : setting_.integrator == "explicit-euler" ? Rival::explicit_euler
                                                                          : Rival::exact_ou_sum;
            const auto dt = static_cast<float>(setting_.dt_s);
            rogue_ += step_rival(which, {job_.grid, rival_.data()}, run_.flakes(), run_.slots(), dt,
                                 world_.seed, number_);
        }
        else if (on_backend())
            run_.step();
        else
        {
            const Sampling sampling =
                setting_.sampling == "nearest" ? Sampling::nearest : Sampling::trilinear;
            if (setting_.precision == "half")
                step_on_grid(job_, half_.data(), sampling, run_.slots());
            else
                step_on_grid(job_, own_.data(), sampling, run_.slots());
        }
    }

    /// As ours has them: q.
    void finish()
    {
        if (rival()) scale_velocities(-1);
    }

    const World& world() const { return world_; }
    const FlakeRun& run() const { return run_; }
    std::uint32_t number() const { return number_; }
    const AdvectJob& job() const { return job_; }
    const std::vector<float>& numbers() const { return own_; }
    double rogue_share() const { return static_cast<double>(rogue_) / static_cast<double>(run_.slots()); }
    bool rival() const { return setting_.integrator != "ours"; }

  private:
    static Settings one_thread(std::uint64_t flakes)
    {
        Settings settings;
        settings.particles = flakes;
        settings.threads = 1;
        return settings;
    }

    bool on_backend() const { return setting_.precision == "float" && setting_.sampling == "trilinear"; }

    static cpu::CpuOptions options(const AdvectionSetting& setting)
    {
        cpu::CpuOptions options;
        options.threads = 1;
        if (setting.code == "one-by-one") options.simd = cpu::Simd::scalar_fma;
        return options;
    }

    void to_velocities() { scale_velocities(1); }

    /// u' = sigma q (power 1) or back (-1); the other two components have sigma = 1.
    void scale_velocities(double power)
    {
        const FlakeView& f = run_.flakes();
        for (std::size_t i = 0; i < run_.slots(); ++i)
        {
            const double sigma =
                std::sqrt(1.1 + std::sin(2 * std::numbers::pi * static_cast<double>(f.x[i])));
            f.q1[i] = static_cast<float>(static_cast<double>(f.q1[i]) * std::pow(sigma, power));
        }
    }

    AdvectionSetting setting_;
    Settings settings_;
    World world_;
    FlakeRun run_;
    AdvectJob job_;
    Region region_;
    std::vector<float> own_, rival_;
    std::vector<std::uint16_t> half_;
    std::uint32_t number_ = 0;
    std::uint64_t rogue_ = 0;
};

/// Ours only: how far float, half or nearest lead away from the same walk in double within a second.
double path_error(const AdvectionSetting& setting)
{
    constexpr std::uint64_t kFlakes = 2000;
    Walk walk(setting, kFlakes);
    const FlakeView& f = walk.run().flakes();
    std::vector<double> states;
    for (std::size_t i = 0; i < kFlakes; ++i)
        for (const float v : {f.x[i], f.y[i], f.z[i], f.q1[i], f.q2[i], f.q3[i]}) states.push_back(v);
    const std::vector<std::uint32_t> ids(f.id, f.id + kFlakes);
    const auto steps = std::max(1L, std::lround(1 / setting.dt_s));
    for (long s = 0; s < steps; ++s)
    {
        walk.step();
        step_in_double(walk.job().grid, walk.numbers().data(), states.data(), ids.data(), kFlakes,
                       walk.job().step, setting.dt_s, walk.number());
    }
    std::vector<double> by_id(kFlakes, 0);
    for (std::size_t i = 0; i < kFlakes; ++i) by_id[f.id[i]] = static_cast<double>(f.x[i]);
    double square = 0;
    for (std::size_t i = 0; i < kFlakes; ++i)
    {
        double off = std::abs(by_id[ids[i]] - states[6 * i]);
        off = std::min(off, 1 - off);  // across the wrap
        square += off * off / kFlakes;
    }
    return std::sqrt(square);
}

}  // namespace

std::string AdvectionSetting::name() const
{
    return fmt::format("{}/{}/{}/{}/dt-{:g}", integrator, precision, sampling, code, dt_s);
}

std::vector<AdvectionSetting> advection_sweep()
{
    constexpr double kDefaultStep_s = 1.0 / 60;  // World::step_s
    std::vector<AdvectionSetting> all;
    const auto add = [&](AdvectionSetting setting, std::initializer_list<double> steps)
    {
        for (const double dt : steps)
        {
            setting.dt_s = dt;
            setting.is_default = dt == kDefaultStep_s && setting.code == "packs";
            all.push_back(setting);
        }
    };
    add({"ours", "float", "trilinear", "packs", 16}, {0.005, 0.01, kDefaultStep_s, 0.05, 0.1, 0.2, 0.4});
    add({"ours"}, {0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.4});
    for (const char* precision : {"float", "half"})
        for (const char* sampling : {"trilinear", "nearest"})
            if (std::string(precision) != "float" || std::string(sampling) != "trilinear")
                add({"ours", precision, sampling}, {0.02, 0.1});
    for (const char* rival : {"bailey", "explicit-euler", "exact-ou-sum"})
        add({rival}, {0.005, 0.01, 0.02, 0.04, 0.1, 0.2, 0.4});
    return all;
}

AdvectionPoint measure_advection(const AdvectionSetting& setting, std::uint64_t flakes, double seconds)
{
    const std::vector<cpu::Simd> available = cpu::available_simd();
    if (std::find(available.begin(), available.end(), cpu::Simd::scalar_fma) == available.end())
        throw Error(
            "this processor has no AVX2 with FMA, which the comparison of integrators is compiled for");
    AdvectionPoint point;
    point.setting = setting;
    Walk walk(setting, flakes);
    const auto steps = std::max(1L, std::lround(seconds / setting.dt_s) - 1);
    const auto start = Clock::now();
    for (long s = 0; s < steps; ++s) walk.step();
    point.ns_per_flake_second =
        ms_since(start) * 1e6 / (static_cast<double>(flakes) * static_cast<double>(steps) * setting.dt_s);
    walk.finish();
    const Mixing m = mixing(walk.world(), walk.run(), Along::x, 0, 1);
    point.error = m.flakes > 0 ? std::hypot(m.density_rms, m.variance_rms) : 1e3;
    point.noise = std::sqrt(3.0 * kMixedBins / static_cast<double>(flakes));
    point.rogue_share = walk.rogue_share();
    if (!walk.rival()) point.path_error_m = path_error(setting);
    return point;
}

/// Of the noise of an error, that two of them may differ by: each is the root of a mean of 50 squares, known
/// to a tenth; three standard deviations of the difference.
constexpr double kChance = 0.42;

std::vector<SolverSetting> solver_sweep(int most_cells)
{
    std::vector<SolverSetting> all;
    for (const int cells : {16, 32, 64, 96})
        if (cells <= most_cells)
            for (const double tolerance : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8})
                all.push_back({cells, tolerance});
    return all;
}

SolverPoint measure_solver(const SolverSetting& setting, int threads)
{
    const Manufactured field(setting.cells, 0);
    SolverPoint point;
    point.cells = setting.cells, point.tolerance = setting.tolerance;
    point.is_default = setting.tolerance == PoissonSettings{}.tolerance;
    tbb::task_arena arena(threads > 0 ? threads : tbb::task_arena::automatic);
    std::vector<double> x, ms;
    for (int round = 0; round < 3; ++round)
        arena.execute(
            [&]
            {
                PoissonSettings settings;
                settings.tolerance = setting.tolerance;
                const auto start = Clock::now();
                point.iterations = cpu::PoissonSolver(field.problem).solve(field.b, x, settings).iterations;
                ms.push_back(ms_since(start));
            });
    point.ms = *std::min_element(ms.begin(), ms.end());
    point.error = field.error(x);
    return point;
}

void mark_frontier(std::vector<AdvectionPoint>& points)
{
    const auto beats = [](const AdvectionPoint& other, const AdvectionPoint& p)
    {
        if (other.ns_per_flake_second >= p.ns_per_flake_second) return false;
        const double chance = kChance * p.noise;
        if (other.error < p.error - chance) return true;
        return other.error <= p.error + chance && other.setting.dt_s <= p.setting.dt_s;
    };
    for (AdvectionPoint& p : points)
        p.on_frontier = std::none_of(points.begin(), points.end(),
                                     [&](const AdvectionPoint& other) { return beats(other, p); });
}

void mark_frontier(std::vector<SolverPoint>& points)
{
    for (SolverPoint& p : points)
        p.on_frontier = std::none_of(points.begin(), points.end(),
                                     [&](const SolverPoint& other)
                                     { return other.ms < p.ms && other.error < p.error * 0.999; });
}

double equal_error_at_ten_times(const std::vector<AdvectionPoint>& points)
{
    double longest = 0;
    for (const AdvectionPoint& ours : points)
        for (const AdvectionPoint& other : points)
        {
            const AdvectionSetting &a = ours.setting, &b = other.setting;
            const bool pair = a.integrator == "ours" && a.precision == "float" && a.sampling == "trilinear" &&
                              b.integrator == "bailey" && std::abs(a.dt_s - 10 * b.dt_s) < 1e-6;
            if (pair && ours.error <= other.error + kChance * ours.noise) longest = std::max(longest, a.dt_s);
        }
    return longest;
}

}  // namespace spindrift::validation
