// SPDX-License-Identifier: MIT
#include "app/stage_log.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace spindrift::app
{

double quantile(std::vector<float> samples, double q)
{
    if (samples.empty()) return 0;
    const double rank = std::ceil(q * static_cast<double>(samples.size())) - 1;
    const auto index = static_cast<std::size_t>(std::max(rank, 0.0));
    const auto nth = samples.begin() + static_cast<std::ptrdiff_t>(index);
    std::nth_element(samples.begin(), nth, samples.end());
    return *nth;
}

void StageLog::add(std::string_view stage, double ms)
{
    auto found =
        std::find_if(stages_.begin(), stages_.end(), [&](const Stage& s) { return s.name == stage; });
    if (found == stages_.end()) found = stages_.insert(stages_.end(), Stage{std::string(stage), {}});
    if (keep_ == Keep::newest) found->samples_ms.clear();
    found->samples_ms.push_back(static_cast<float>(ms));
}

std::vector<StageSummary> StageLog::summaries() const
{
    std::vector<StageSummary> result;
    for (const Stage& stage : stages_)
    {
        const double total = std::accumulate(stage.samples_ms.begin(), stage.samples_ms.end(), 0.0);
        result.push_back({stage.name, stage.samples_ms.size(), quantile(stage.samples_ms, 0.5),
                          quantile(stage.samples_ms, 0.95), total});
    }
    return result;
}

std::vector<std::pair<std::string, double>> StageLog::newest() const
{
    std::vector<std::pair<std::string, double>> result;
    for (const Stage& stage : stages_) result.emplace_back(stage.name, stage.samples_ms.back());
    return result;
}

}  // namespace spindrift::app
