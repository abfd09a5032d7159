// SPDX-License-Identifier: MIT
#include "cpu/sort/histogram_pool.h"

#include <mutex>
#include <utility>

#include <tbb/cache_aligned_allocator.h>

namespace spindrift::cpu
{

struct HistogramLease::Block
{
    explicit Block(std::size_t size) : capacity(size), counters(allocator.allocate(size)) {}
    ~Block() { allocator.deallocate(counters, capacity); }
    Block(const Block&) = delete;
    Block& operator=(const Block&) = delete;

    tbb::cache_aligned_allocator<std::uint32_t> allocator;
    std::size_t capacity;
    std::uint32_t* counters;
    std::unique_ptr<Block> next;  // of the blocks that nobody borrows
};

namespace
{

struct FreeBlocks
{
    std::mutex mutex;
    std::unique_ptr<HistogramLease::Block> first;
};

FreeBlocks& free_blocks()
{
    static FreeBlocks blocks;
    return blocks;
}

std::unique_ptr<HistogramLease::Block> take_free_block()
{
    FreeBlocks& free = free_blocks();
    const std::lock_guard lock(free.mutex);
    auto block = std::move(free.first);
    if (block) free.first = std::move(block->next);
    return block;
}

}  // namespace

HistogramLease::HistogramLease(std::size_t counters) : block_(take_free_block())
{
    if (!block_ || block_->capacity < counters)
    {
        block_.reset();
        block_ = std::make_unique<Block>(counters);
    }
}

HistogramLease::~HistogramLease()
{
    FreeBlocks& free = free_blocks();
    const std::lock_guard lock(free.mutex);
    block_->next = std::move(free.first);
    free.first = std::move(block_);
}

std::uint32_t* HistogramLease::counters() const
{
    return block_->counters;
}

}  // namespace spindrift::cpu
