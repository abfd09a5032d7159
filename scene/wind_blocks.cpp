// SPDX-License-Identifier: MIT
#include "scene/wind_blocks.h"

#include <algorithm>
#include <cmath>

namespace spindrift::scene
{

namespace
{

constexpr double kSquare = 0.26794919243112270;  ///< tan 15 degrees

}  // namespace

WindBlock::WindBlock(const Footprint& footprint, Vec3d to, double strip_m)
    : to_(to),
      base_m_(footprint.base_m),
      top_m_(footprint.top_m),
      ground_m_(footprint.ground_m),
      front_(INFINITY),
      lee_(-INFINITY),
      low_t_(INFINITY),
      strip_m_(strip_m)
{
    double high_t = -INFINITY;
    for (const auto& outline : footprint.outlines)
        for (const Vec3d& p : outline)
        {
            front_ = std::min(front_, s(p));
            lee_ = std::max(lee_, s(p));
            low_t_ = std::min(low_t_, t(p));
            high_t = std::max(high_t, t(p));
        }
    middle_ = 0.5 * (low_t_ + high_t);
    size_ = {top_m_ - ground_m_, high_t - low_t_, lee_ - front_};
    const auto count = static_cast<std::size_t>(std::max(1.0, std::ceil(size_.width / strip_m - 1e-6)));
    strip_m_ = size_.width / static_cast<double>(count);
    strips_.assign(count, {INFINITY, -INFINITY});
    for (const auto& outline : footprint.outlines) add(outline, strip_m_);
    double last_front = -INFINITY;
    for (const Strip& strip : strips_)
        if (strip.any()) last_front = std::max(last_front, strip.front);
    square_ = last_front - front_ <= kSquare * size_.width;
}

/// Where the middle line of every strip enters and leaves the outline.
void WindBlock::add(const std::vector<Vec3d>& outline, double strip_m)
{
    for (std::size_t i = 0; i < outline.size(); ++i)
    {
        const Vec3d &a = outline[i], &b = outline[(i + 1) % outline.size()];
        const double from = std::min(t(a), t(b)), to = std::max(t(a), t(b));
        if (!(to > from)) continue;
        const auto first = static_cast<std::ptrdiff_t>(std::ceil((from - low_t_) / strip_m - 0.5 - 1e-9));
        for (std::ptrdiff_t k = std::max<std::ptrdiff_t>(first, 0); k < std::ssize(strips_); ++k)
        {
            const double middle = low_t_ + (static_cast<double>(k) + 0.5) * strip_m;
            if (middle > to + 1e-9 * strip_m) break;
            const double at = s(a) + (s(b) - s(a)) * (middle - t(a)) / (t(b) - t(a));
            strips_[k].front = std::min(strips_[k].front, at);
            strips_[k].lee = std::max(strips_[k].lee, at);
        }
    }
}

WindBlock::Strip WindBlock::strip(double t) const
{
    const double at = std::floor((t - low_t_) / strip_m_);
    if (!(at >= 0 && at < static_cast<double>(strips_.size()))) return {INFINITY, -INFINITY};
    return strips_[static_cast<std::size_t>(at)];
}

}  // namespace spindrift::scene
