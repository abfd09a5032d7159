// SPDX-License-Identifier: MIT
#include <atomic>
#include <cstdlib>
#include <new>

#include <gtest/gtest.h>

#include "worlds.h"

namespace
{

std::atomic<bool> counting{false};
std::atomic<int> allocations{0};

// out of line: where gcc inlines one of a pair of operators only, it takes malloc and delete for a mismatch
__attribute__((noinline)) void* allocate(std::size_t bytes)
{
    if (counting) ++allocations;
    if (void* p = std::malloc(bytes == 0 ? 1 : bytes)) return p;
    throw std::bad_alloc();
}

__attribute__((noinline)) void release(void* p)
{
    std::free(p);
}

}  // namespace

void* operator new(std::size_t bytes)
{
    return allocate(bytes);
}
void* operator new[](std::size_t bytes)
{
    return allocate(bytes);
}
void operator delete(void* p) noexcept
{
    release(p);
}
void operator delete[](void* p) noexcept
{
    release(p);
}
void operator delete(void* p, std::size_t) noexcept
{
    release(p);
}
void operator delete[](void* p, std::size_t) noexcept
{
    release(p);
}

namespace spindrift::cpu::test
{
namespace
{

TEST(Memory, NothingIsAllocatedPerStepOrFrame)
{
#if defined(__SANITIZE_THREAD__)
    GTEST_SKIP() << "ThreadSanitizer builds start threads of their own (cpu/parallel.h)";
#endif
    TestRun run(world_with_everything(16384, OnLeave::respawn, true), {2, Simd::automatic});
    View view;
    view.eye = {20, -20, 10};
    const SortSettings radix{"radix", 32};
    for (int i = 0; i < 30; ++i)
    {
        run->step();
        run->prepare(view, radix);
    }
    counting = true;
    for (int i = 0; i < 60; ++i)
    {
        run->step();
        run->prepare(view, radix);
    }
    counting = false;
    EXPECT_EQ(allocations, 0);
    EXPECT_GT(run->counts().alive, 5000U);
}

}  // namespace
}  // namespace spindrift::cpu::test
