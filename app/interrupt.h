// SPDX-License-Identifier: MIT
#pragma once

namespace spindrift::app
{

/// While it lives, SIGINT and SIGTERM ask the run to end after the frame at hand instead of killing it, and a
/// broken pipe is an error that writing reports. A second signal of the same kind kills as usual. One at a
/// time.
class InterruptWatch
{
  public:
    InterruptWatch();
    ~InterruptWatch();
    InterruptWatch(const InterruptWatch&) = delete;
    InterruptWatch& operator=(const InterruptWatch&) = delete;

    bool requested() const;
};

}  // namespace spindrift::app
