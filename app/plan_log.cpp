// SPDX-License-Identifier: MIT
#include "app/plan_log.h"

#include <algorithm>

namespace spindrift::app
{

namespace
{

/// The words of a reason: numbers in it may change from frame to frame.
std::string without_digits(std::string text)
{
    std::erase_if(text, [](char c) { return c >= '0' && c <= '9'; });
    return text;
}

void note(std::vector<std::string>& reasons, const std::string& reason)
{
    const auto same = [&](const std::string& known)
    { return without_digits(known) == without_digits(reason); };
    if (std::none_of(reasons.begin(), reasons.end(), same)) reasons.push_back(reason);
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

void PlanLog::left_out_after_all(const std::string& pass, const std::string& reason)
{
    const auto found =
        std::find_if(passes_.begin(), passes_.end(), [&](const PassHistory& h) { return h.name == pass; });
    if (found == passes_.end() || found->ran == 0) return;
    --found->ran;
    ++found->skipped;
    if (found->ran == 0) found->ran_because.clear();
    note(found->skipped_because, reason);
}

}  // namespace spindrift::app
