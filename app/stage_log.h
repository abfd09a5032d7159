// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift::app
{

/// Times of one stage over a run, in milliseconds.
struct StageSummary
{
    std::string name;
    std::size_t samples = 0;
    double median_ms = 0, p95_ms = 0, total_ms = 0;
};

/// Collects a time per stage and call; order of first mention is kept.
class StageLog
{
  public:
    enum class Keep
    {
        all,     ///< for summaries at the end of a run
        newest,  ///< for runs without an end
    };
    StageLog() = default;
    explicit StageLog(Keep keep) : keep_(keep) {}

    void add(std::string_view stage, double ms);
    std::vector<StageSummary> summaries() const;
    /// The newest sample of each stage, for the overlay.
    std::vector<std::pair<std::string, double>> newest() const;

  private:
    struct Stage
    {
        std::string name;
        std::vector<float> samples_ms;
    };
    Keep keep_ = Keep::all;
    std::vector<Stage> stages_;
};

/// Nearest-rank quantile of unsorted samples, q in [0, 1]; 0 without samples.
double quantile(std::vector<float> samples, double q);

/// Adds the time that it lived to a stage.
class StageTimer
{
  public:
    StageTimer(StageLog& log, std::string_view stage) : log_(log), stage_(stage) {}
    ~StageTimer()
    {
        const std::chrono::duration<double, std::milli> lived = std::chrono::steady_clock::now() - start_;
        log_.add(stage_, lived.count());
    }
    StageTimer(const StageTimer&) = delete;
    StageTimer& operator=(const StageTimer&) = delete;

  private:
    StageLog& log_;
    std::string_view stage_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace spindrift::app
