// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "gl/object.h"

namespace spindrift::gl
{

/// GPU time of each pass, double buffered: the results of one frame are fetched when the next but one begins,
/// so that nobody waits.
class PassTimers
{
  public:
    struct Time
    {
        std::string name;
        double ms;
    };

    void begin_frame();
    void begin(std::string_view pass);
    void end();

    /// Of the last frame whose results have arrived.
    const std::vector<Time>& times() const { return times_; }

  private:
    struct Frame
    {
        std::vector<Query> queries;      // as many as any frame needed
        std::vector<std::string> names;  // of the passes of this frame
    };
    void collect(const Frame& frame);

    std::array<Frame, 2> frames_;
    std::size_t current_ = 0;
    std::vector<Time> times_;
};

}  // namespace spindrift::gl
