// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace spindrift::app
{

/// One line on stderr with a bar, the rate and the time left; silent where stderr is no terminal.
class ProgressBar
{
  public:
    /// `unit`: what is counted, in the plural ("frames", "steps").
    ProgressBar(std::string unit, std::uint64_t total);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(std::uint64_t done);

  private:
    using Clock = std::chrono::steady_clock;

    std::string unit_;
    std::uint64_t total_;
    bool terminal_;
    bool drawn_ = false;
    Clock::time_point start_;
    Clock::time_point last_;
};

/// The line itself: "12/90 frames [===>      ] 3.4 frames/s, 23 s left".
std::string progress_line(const std::string& unit, std::uint64_t done, std::uint64_t total, double elapsed_s);

}  // namespace spindrift::app
