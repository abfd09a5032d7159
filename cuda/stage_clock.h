// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstddef>

#include "core/backend.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

/// Times of the stages of a call on the device, sampled: while one call's are still on their way, others go
/// unmeasured, so that nobody waits.
template <std::size_t Stages>
class StageClock
{
  public:
    void begin(StreamRef stream)
    {
        read();
        measuring_ = !pending_;
        if (measuring_) marks_[0].record(stream);
    }
    /// The end of stage `stage`.
    void mark(StreamRef stream, std::size_t stage)
    {
        if (!measuring_) return;
        marks_[stage + 1].record(stream);
        pending_ = stage + 1 == Stages;
    }
    /// The newest that are known, ms; NaN before that.
    const std::array<double, Stages>& read()
    {
        if (!pending_ || !marks_[Stages].is_done()) return ms_;
        for (std::size_t s = 0; s < Stages; ++s) ms_[s] = marks_[s + 1].ms_since(marks_[s]);
        pending_ = false;
        return ms_;
    }

  private:
    struct Mark : Event
    {
        Mark() : Event(Timing::on) {}
    };
    static std::array<double, Stages> unknown()
    {
        std::array<double, Stages> ms;
        ms.fill(kNotMeasured);
        return ms;
    }

    std::array<Mark, Stages + 1> marks_;
    std::array<double, Stages> ms_ = unknown();
    bool measuring_ = false;
    bool pending_ = false;
};

}  // namespace spindrift::gpu
