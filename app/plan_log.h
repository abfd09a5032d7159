// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "gl/frame_plan.h"

namespace spindrift::app
{

/// How often a pass ran or was left out over a run, and every reason that was given.
struct PassHistory
{
    std::string name;
    std::uint64_t ran = 0, skipped = 0;
    std::vector<std::string> ran_because, skipped_because;  ///< each reason once, whatever its numbers
};

class PlanLog
{
  public:
    void add(const gl::FramePlan& plan);
    /// The pass of the last plan that was to run did nothing.
    void left_out_after_all(const std::string& pass, const std::string& reason);
    const std::vector<PassHistory>& passes() const { return passes_; }

  private:
    std::vector<PassHistory> passes_;
};

}  // namespace spindrift::app
