// SPDX-License-Identifier: MIT
#include <algorithm>
#include <array>
#include <new>

#include "cpu/cpu_backend.h"

namespace spindrift::cpu
{

namespace
{

constexpr std::size_t kAlignment = 64;

struct AlignedDelete
{
    void operator()(void* p) const { ::operator delete (p, std::align_val_t{kAlignment}); }
};

using AlignedBytes = std::unique_ptr<void, AlignedDelete>;

AlignedBytes aligned_zeros(std::size_t bytes)
{
    const std::size_t padded = (bytes + kAlignment - 1) / kAlignment * kAlignment;
    void* p = ::operator new (std::max(padded, kAlignment), std::align_val_t{kAlignment});
    std::fill_n(static_cast<unsigned char*>(p), padded, static_cast<unsigned char>(0));
    return AlignedBytes(p);
}

}  // namespace

struct HostFlakes::Arrays
{
    std::array<AlignedBytes, 11> state;
    AlignedBytes pairs, scratch;
};

HostFlakes::HostFlakes(std::size_t capacity) : arrays_(std::make_unique<Arrays>())
{
    for (AlignedBytes& array : arrays_->state) array = aligned_zeros(capacity * sizeof(float));
    arrays_->pairs = aligned_zeros(capacity * sizeof(std::uint64_t));
    arrays_->scratch = aligned_zeros(capacity * sizeof(std::uint64_t));
}

HostFlakes::~HostFlakes() = default;
HostFlakes::HostFlakes(HostFlakes&&) noexcept = default;
HostFlakes& HostFlakes::operator=(HostFlakes&&) noexcept = default;

FlakeView HostFlakes::flakes() const
{
    const auto f = [&](std::size_t i) { return static_cast<float*>(arrays_->state[i].get()); };
    const auto u = [&](std::size_t i) { return static_cast<std::uint32_t*>(arrays_->state[i].get()); };
    return {f(0), f(1), f(2), f(3), f(4), f(5), f(6), f(7), f(8), u(9), u(10)};
}

DrawListView HostFlakes::draw_list() const
{
    return {static_cast<std::uint64_t*>(arrays_->pairs.get()),
            static_cast<std::uint64_t*>(arrays_->scratch.get())};
}

}  // namespace spindrift::cpu
