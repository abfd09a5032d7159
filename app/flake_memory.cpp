// SPDX-License-Identifier: MIT
#include "app/flake_memory.h"

#include <cstring>

#include "cpu/cpu_backend.h"

namespace spindrift::app
{

namespace
{

constexpr std::size_t kHostBytesPerFlake = kStateBytesPerFlake + kDrawListBytesPerFlake;

class HostMemory final : public HostFlakeMemory
{
  public:
    explicit HostMemory(std::size_t capacity) : capacity_(capacity), host_(capacity) {}
    FlakeView flakes() const override { return host_.flakes(); }
    DrawListView draw_list() const override { return host_.draw_list(); }
    std::size_t bytes() const override { return capacity_ * kHostBytesPerFlake; }
    const gl::FlakeBuffers* drawn_from() const override { return nullptr; }
    void hand_over(std::size_t, const DrawList&) override {}

  private:
    std::size_t capacity_;
    cpu::HostFlakes host_;
};

class SharedMemory final : public HostFlakeMemory
{
  public:
    explicit SharedMemory(std::size_t capacity) : buffers_(capacity) {}
    FlakeView flakes() const override { return buffers_.flakes(); }
    DrawListView draw_list() const override { return buffers_.draw_list(); }
    std::size_t bytes() const override { return buffers_.bytes(); }
    const gl::FlakeBuffers* drawn_from() const override { return &buffers_; }
    void hand_over(std::size_t, const DrawList&) override {}

  private:
    gl::FlakeBuffers buffers_;
};

template <class T>
void copy(T* to, const T* from, std::size_t n)
{
    if (n > 0) std::memcpy(to, from, n * sizeof(T));
}

class StagedMemory final : public HostFlakeMemory
{
  public:
    explicit StagedMemory(std::size_t capacity) : host_(capacity), buffers_(capacity) {}
    FlakeView flakes() const override { return host_.flakes(); }
    DrawListView draw_list() const override { return host_.draw_list(); }
    std::size_t bytes() const override { return buffers_.bytes() + buffers_.capacity() * kHostBytesPerFlake; }
    const gl::FlakeBuffers* drawn_from() const override { return &buffers_; }

    void hand_over(std::size_t used, const DrawList& list) override
    {
        const FlakeView from = host_.flakes();
        const FlakeView to = buffers_.flakes();
        for (auto array : {&FlakeView::x, &FlakeView::y, &FlakeView::z, &FlakeView::q1, &FlakeView::q2,
                           &FlakeView::q3, &FlakeView::slip_x, &FlakeView::slip_y, &FlakeView::slip_z})
            copy(to.*array, from.*array, used);
        for (auto array : {&FlakeView::id, &FlakeView::state}) copy(to.*array, from.*array, used);

        const auto pairs = list.in_scratch ? &DrawListView::scratch : &DrawListView::pairs;
        copy(buffers_.draw_list().*pairs, host_.draw_list().*pairs, list.count);
    }

  private:
    cpu::HostFlakes host_;
    gl::FlakeBuffers buffers_;
};

}  // namespace

std::unique_ptr<HostFlakeMemory> make_host_memory(std::size_t capacity)
{
    return std::make_unique<HostMemory>(capacity);
}
std::unique_ptr<HostFlakeMemory> make_shared_memory(std::size_t capacity)
{
    return std::make_unique<SharedMemory>(capacity);
}
std::unique_ptr<HostFlakeMemory> make_staged_memory(std::size_t capacity)
{
    return std::make_unique<StagedMemory>(capacity);
}

}  // namespace spindrift::app
