// SPDX-License-Identifier: MIT
#include "validation/residence.h"

#include <cmath>

namespace spindrift::validation
{

ResidenceMeter::ResidenceMeter(std::vector<Sampler> samplers)
    : samplers_(std::move(samplers)), time_s_(samplers_.size() * kBatches, 0)
{
}

void ResidenceMeter::look(const FlakeRun& run, double step_s)
{
    const FlakeView& f = run.flakes();
    for (std::size_t i = 0; i < run.slots(); ++i)
    {
        if (!run.alive(i)) continue;
        const double x = f.x[i], z = f.z[i];
        for (std::size_t s = 0; s < samplers_.size(); ++s)
        {
            const Sampler& sampler = samplers_[s];
            if (2 * std::abs(x - sampler.x_m) < sampler.length_m &&
                2 * std::abs(z - sampler.z_m) < sampler.height_m)
                time_s_[s * kBatches + f.id[i] % kBatches] += step_s;
        }
    }
}

std::vector<Reading> ResidenceMeter::readings(std::uint64_t flakes) const
{
    std::vector<Reading> result;
    for (std::size_t s = 0; s < samplers_.size(); ++s)
    {
        const double area = samplers_[s].length_m * samplers_[s].height_m * static_cast<double>(flakes);
        double sum = 0, squares = 0;
        for (std::size_t b = 0; b < kBatches; ++b)
        {
            const double t = time_s_[s * kBatches + b] / area;
            sum += t, squares += t * t;
        }
        const double n = kBatches, mean = sum / n;
        result.push_back({sum, std::sqrt(std::max(0.0, (squares / n - mean * mean) * n / (n - 1)) * n)});
    }
    return result;
}

}  // namespace spindrift::validation
