// SPDX-License-Identifier: MIT
#include "app/progress_bar.h"

#include <cstdio>
#include <utility>

#include <fmt/format.h>
#include <unistd.h>

namespace spindrift::app
{

namespace
{

constexpr int kBarCells = 30;
constexpr double kRedrawEvery_s = 0.1;

std::string duration(double seconds)
{
    const auto whole = static_cast<long long>(seconds + 0.5);
    if (whole < 60) return fmt::format("{} s", whole);
    if (whole < 3600) return fmt::format("{} min {:02} s", whole / 60, whole % 60);
    return fmt::format("{} h {:02} min", whole / 3600, whole / 60 % 60);
}

}  // namespace

std::string progress_line(const std::string& unit, std::uint64_t done, std::uint64_t total, double elapsed_s)
{
    const double share = total > 0 ? static_cast<double>(done) / static_cast<double>(total) : 1.0;
    const int filled = static_cast<int>(share * kBarCells);
    std::string bar(static_cast<std::size_t>(kBarCells), ' ');
    for (int i = 0; i < filled; ++i) bar[static_cast<std::size_t>(i)] = '=';
    if (filled < kBarCells) bar[static_cast<std::size_t>(filled)] = '>';

    std::string line = fmt::format("{}/{} {} [{}]", done, total, unit, bar);
    if (done == 0 || elapsed_s <= 0) return line;
    const double rate = static_cast<double>(done) / elapsed_s;
    return line + fmt::format(" {:.1f} {}/s, {} left", rate, unit,
                              duration(static_cast<double>(total - done) / rate));
}

ProgressBar::ProgressBar(std::string unit, std::uint64_t total)
    : unit_(std::move(unit)),
      total_(total),
      terminal_(isatty(STDERR_FILENO) != 0),
      start_(Clock::now()),
      last_(start_)
{
}

ProgressBar::~ProgressBar()
{
    if (drawn_) std::fputs("\n", stderr);
}

void ProgressBar::show(std::uint64_t done)
{
    if (!terminal_) return;
    const auto now = Clock::now();
    const std::chrono::duration<double> since_last = now - last_;
    if (drawn_ && done < total_ && since_last.count() < kRedrawEvery_s) return;
    last_ = now;
    drawn_ = true;
    const std::chrono::duration<double> elapsed = now - start_;
    // "\033[K" clears what a longer line left behind.
    fmt::print(stderr, "\r{}\033[K", progress_line(unit_, done, total_, elapsed.count()));
    std::fflush(stderr);
}

}  // namespace spindrift::app
