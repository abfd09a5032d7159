// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/platform.h"

namespace spindrift
{

/// Puts flakes of equal depth keys in the order in which they were emitted, after a sort that left them in
/// the order of their slots. Needed only where slots do not ascend with emission: after a re-ordering by
/// cell. operator() looks at one place of the list; any order, any threads.
struct EmissionOrder
{
    std::uint64_t* pairs;  ///< n, ascending by key
    std::size_t n;
    const std::uint32_t* id;  ///< by slot
    std::uint32_t next_id;    ///< serial number of the next flake, modulo 2^32

    /// Does nothing unless a run of equal keys begins at i.
    SPINDRIFT_HD void operator()(std::size_t i) const
    {
        const std::uint32_t key = key_of(i);
        if (i > 0 && key_of(i - 1) == key) return;
        std::size_t end = i + 1;
        bool ascends = true;
        for (; end < n && key_of(end) == key; ++end) ascends = ascends && before(pairs[end - 1], pairs[end]);
        if (!ascends) heap_sort(pairs + i, end - i);
    }

  private:
    SPINDRIFT_HD std::uint32_t key_of(std::size_t i) const
    {
        return static_cast<std::uint32_t>(pairs[i] >> 32);
    }
    /// Flakes that were made since; ids may have come round to 0, so they cannot be compared themselves.
    SPINDRIFT_HD std::uint32_t age(std::uint64_t pair) const
    {
        return next_id - id[static_cast<std::uint32_t>(pair)];
    }
    SPINDRIFT_HD bool before(std::uint64_t a, std::uint64_t b) const { return age(a) > age(b); }

    /// In place and never quadratic, because a run may be as long as the list.
    SPINDRIFT_HD void heap_sort(std::uint64_t* run, std::size_t count) const
    {
        for (std::size_t root = count / 2; root-- > 0;) sift_down(run, root, count);
        for (std::size_t last = count - 1; last > 0; --last)
        {
            const std::uint64_t youngest = run[0];
            run[0] = run[last];
            run[last] = youngest;
            sift_down(run, 0, last);
        }
    }
    SPINDRIFT_HD void sift_down(std::uint64_t* run, std::size_t root, std::size_t count) const
    {
        const std::uint64_t sunk = run[root];
        for (std::size_t child = 2 * root + 1; child < count; child = 2 * root + 1)
        {
            if (child + 1 < count && before(run[child], run[child + 1])) ++child;
            if (!before(sunk, run[child])) break;
            run[root] = run[child];
            root = child;
        }
        run[root] = sunk;
    }
};

}  // namespace spindrift
