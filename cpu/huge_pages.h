// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>

#include <sys/mman.h>

namespace spindrift::cpu
{

/// Asks the kernel to hold what it can of [memory, memory + bytes) in huge pages from now on: who reads or
/// writes at random places of many megabytes then waits less often for addresses to be translated. The
/// content stays. A refusal costs speed only: memory of a graphics card, kernels without huge pages.
inline void ask_for_huge_pages(void* memory, std::size_t bytes)
{
    constexpr std::uintptr_t kHugePage_bytes = std::uintptr_t{2} << 20;
    constexpr int kCollapse = 25;  // MADV_COLLAPSE of Linux 6.1, which older headers lack
    const auto begin = reinterpret_cast<std::uintptr_t>(memory);
    const std::uintptr_t first = (begin + kHugePage_bytes - 1) / kHugePage_bytes * kHugePage_bytes;
    const std::uintptr_t last = (begin + bytes) / kHugePage_bytes * kHugePage_bytes;
    if (first >= last) return;
    void* const pages = reinterpret_cast<void*>(first);
    madvise(pages, last - first, MADV_HUGEPAGE);  // those that nobody has touched yet
    madvise(pages, last - first, kCollapse);      // those that are there already
}

}  // namespace spindrift::cpu
