// SPDX-License-Identifier: MIT
#include "app/plan_log.h"

#include <algorithm>

namespace spindrift::app
{

namespace
{

/// Reasons that carry changing numbers could grow without end.
constexpr std::size_t kMostReasons = 8;

void note(std::vector<std::string>& reasons, const std::string& reason)
{
    if (reasons.size() >= kMostReasons || std::find(reasons.begin(), reasons.end(), reason) != reasons.end())
        return;
    reasons.push_back(reason);
}

}  // namespace

void PlanLog::add(const gl::FramePlan& plan)
{
    for (const gl::PlannedPass& pass : plan.passes)
    {
        auto found = std::find_if(passes_.begin(), passes_.end(),
                                  [&](const PassHistory& h) { return h.name == pass.name; });
        if (found == passes_.end())
        {
            found = passes_.insert(passes_.end(), PassHistory{});
            found->name = pass.name;
        }
        ++(pass.runs ? found->ran : found->skipped);
        note(pass.runs ? found->ran_because : found->skipped_because, pass.reason);
    }
}

}  // namespace spindrift::app
