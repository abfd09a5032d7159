// SPDX-License-Identifier: MIT
// The two ways from CUDA to OpenGL: the same flakes arrive, in the same order, whichever way they come.
#include <gmock/gmock.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <random>
#include <string>
#include <vector>

#include "cuda/cuda_backend.h"
#include "cuda/interop/interop_flakes.h"
#include "cuda/interop/pinned_flakes.h"
#include "gl/context.h"
#include "tests/cuda/device_fixture.h"
#include "tests/cuda/failing_calls.h"
#include "tests/gl/stage.h"

namespace spindrift::gpu
{

namespace
{

template <class Memory>
class EveryDrawnMemory : public DeviceTest
{
  protected:
    void SetUp() override
    {
        DeviceTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        gl::test_context();
        errors_before_ = gl::Context::debug_errors();
    }
    void TearDown() override
    {
        EXPECT_EQ(cudaPeekAtLastError(), cudaSuccess) << "an error was left behind";
        EXPECT_EQ(gl::Context::debug_errors(), errors_before_);
    }

    std::string errors_before_;
};

using Memories = testing::Types<InteropFlakes, PinnedFlakes>;
TYPED_TEST_SUITE(EveryDrawnMemory, Memories);

template <class T>
void put(T* device, const std::vector<T>& host)
{
    copy_to_device_now(device, host.data(), host.size());
}

template <class T>
std::vector<T> read_gl(GLuint buffer, std::size_t first, std::size_t count)
{
    std::vector<T> host(count);
    if (count > 0)
        glGetNamedBufferSubData(buffer, static_cast<GLintptr>(first * sizeof(T)),
                                static_cast<GLsizeiptr>(count * sizeof(T)), host.data());
    return host;
}

/// x, y, z, id of what a vertex shader finds for point i of the list, one after the other.
std::vector<std::uint32_t> drawn_words(const gl::FlakeBuffers& buffers, const DrawList& list)
{
    constexpr std::array<std::size_t, 4> kArrays{0, 1, 2, 9};
    const std::size_t first = list.in_scratch ? buffers.list_stride() : 0;
    const auto pairs = read_gl<std::uint64_t>(buffers.list_buffer(), first, list.count);
    std::vector<std::uint32_t> words;
    for (const std::size_t array : kArrays)
    {
        const auto all = read_gl<std::uint32_t>(buffers.state_buffer(), array * buffers.array_stride(),
                                                buffers.capacity());
        for (const std::uint64_t pair : pairs) words.push_back(all[static_cast<std::uint32_t>(pair)]);
    }
    return words;
}

TYPED_TEST(EveryDrawnMemory, GivesGlWhatTheListNames)
{
    // Around the pieces in which copies travel, and across several of them.
    for (const std::size_t capacity : {1UL, 31UL, 257UL, 4097UL, 65536UL, 65537UL, 200'003UL})
    {
        TypeParam memory(capacity);
        const Stream stream;
        std::vector<std::uint32_t> slots(capacity);
        std::iota(slots.begin(), slots.end(), 0U);
        std::shuffle(slots.begin(), slots.end(), std::mt19937(7));
        const std::size_t used = capacity - capacity / 5;
        slots.erase(std::remove_if(slots.begin(), slots.end(), [&](auto s) { return s >= used; }),
                    slots.end());
        for (const bool in_scratch : {false, true})
        {
            DrawList list;
            list.count = std::max<std::size_t>(slots.size() * 3 / 4, 1);
            list.in_scratch = in_scratch;
            std::vector<std::uint64_t> pairs(list.count);
            for (std::size_t i = 0; i < pairs.size(); ++i)
                pairs[i] = std::uint64_t{~i & 0xFFFF} << 32 | slots[i];
            const std::uint32_t salt = in_scratch ? 1000 : 0;
            const auto word = [&](std::uint32_t array, std::uint32_t slot)
            { return array << 24 | (slot + salt); };
            std::vector<std::uint32_t> arrays[4];
            for (std::uint32_t array = 0; array < 4; ++array)
                for (std::uint32_t slot = 0; slot < used; ++slot) arrays[array].push_back(word(array, slot));

            const FlakeAddresses at = memory.map(stream);
            stream.ref().wait();  // mapped for this stream only
            put(in_scratch ? at.draw_list.scratch : at.draw_list.pairs, pairs);
            put(reinterpret_cast<std::uint32_t*>(at.flakes.x), arrays[0]);
            put(reinterpret_cast<std::uint32_t*>(at.flakes.y), arrays[1]);
            put(reinterpret_cast<std::uint32_t*>(at.flakes.z), arrays[2]);
            put(at.flakes.id, arrays[3]);
            memory.hand_over(stream, used, list);
            memory.unmap(stream);

            std::vector<std::uint32_t> expected;
            for (std::uint32_t array = 0; array < 4; ++array)
                for (const std::uint64_t pair : pairs)
                    expected.push_back(word(array, static_cast<std::uint32_t>(pair)));
            const std::vector<std::uint32_t> drawn = drawn_words(memory.drawn_from(), list);
            ASSERT_EQ(drawn.size(), expected.size());
            const auto off = std::ranges::mismatch(drawn, expected);
            ASSERT_TRUE(off.in1 == drawn.end())
                << capacity << " flakes, in scratch: " << in_scratch << ", word " << off.in1 - drawn.begin()
                << " of " << drawn.size() << " is " << *off.in1 << " and not " << *off.in2;
        }
    }
}

TYPED_TEST(EveryDrawnMemory, AnEmptyListIsNoWork)
{
    for (const std::size_t capacity : {0UL, 5UL})
    {
        TypeParam memory(capacity);
        const Stream stream;
        memory.map(stream);
        memory.hand_over(stream, 0, {});
        memory.unmap(stream);
    }
}

TYPED_TEST(EveryDrawnMemory, KeepsItsContentsFromFrameToFrame)
{
    constexpr std::size_t n = 4097;
    TypeParam memory(n);
    const Stream stream;
    MappedFlakes first(memory, stream);
    EXPECT_EQ(reinterpret_cast<std::uintptr_t>(first.addresses().flakes.state) % 64, 0U);
    std::vector<std::uint32_t> states(n);
    std::iota(states.begin(), states.end(), 5U);
    put(first.addresses().flakes.state, states);
    put(first.addresses().draw_list.scratch, std::vector<std::uint64_t>(n, 77));
    first.close();

    const MappedFlakes second(memory, stream);
    std::vector<std::uint32_t> kept(n);
    std::vector<std::uint64_t> pairs(n);
    check(cudaMemcpy(kept.data(), second.addresses().flakes.state, n * 4, cudaMemcpyDeviceToHost),
          "cudaMemcpy");
    check(cudaMemcpy(pairs.data(), second.addresses().draw_list.scratch, n * 8, cudaMemcpyDeviceToHost),
          "cudaMemcpy");
    EXPECT_EQ(kept, states);
    EXPECT_EQ(pairs, std::vector<std::uint64_t>(n, 77));
}

TYPED_TEST(EveryDrawnMemory, DrawsThePictureThatTheHostsMemoryDraws)
{
    gl::Stage stage;
    stage.scene.sky.ambient = {1, 1, 1};
    for (int i = 0; i < 300; ++i)
        stage.add_flake({0.1F * static_cast<float>(i % 17 - 8), 6.0F - 0.018F * static_cast<float>(i),
                         0.07F * static_cast<float>(i % 11 - 5)},
                        static_cast<std::uint32_t>(i));
    const image::Image expected = stage.draw();
    ASSERT_GT(gl::total(expected), 1);

    const std::size_t n = stage.places.size();
    TypeParam memory(n);
    const Stream stream;
    std::vector<float> x;
    std::vector<float> y;
    std::vector<float> z;
    std::vector<std::uint64_t> pairs;
    for (std::size_t i = 0; i < n; ++i)
    {
        x.push_back(stage.places[i].x);
        y.push_back(stage.places[i].y);
        z.push_back(stage.places[i].z);
        pairs.push_back(i);
    }
    {
        MappedFlakes mapped(memory, stream);
        put(mapped.addresses().flakes.x, x);
        put(mapped.addresses().flakes.y, y);
        put(mapped.addresses().flakes.z, z);
        put(mapped.addresses().flakes.id, stage.ids);
        put(mapped.addresses().draw_list.pairs, pairs);
        memory.hand_over(stream, n, {false, n, 0, true});
        mapped.close();
    }
    EXPECT_EQ(stage.draw_from(memory.drawn_from(), {false, n, 0, true}).rgba, expected.rgba);
}

class InteropBuffers : public EveryDrawnMemory<InteropFlakes>
{
};

TEST_F(InteropBuffers, AreGivenBackToGlAfterALookBetweenFrames)
{
    const FailingCalls calls;
    World world;
    world.size_m = {10, 10, 10};
    world.capacity = 100;
    world.emitters.emplace_back();
    world.emitters[0].a = {5, 5, 5};
    world.emitters[0].burst = 60;
    InteropFlakes memory(world.capacity, calls.calls());
    const auto backend = make_cuda_backend(world, memory, {});
    View view;
    view.forward = {0, 1, 0}, view.right = {1, 0, 0}, view.up = {0, 0, 1};
    backend->step();
    backend->close(backend->prepare(view, {}));
    const auto is_mapped = [&] { return calls.counts().map_calls != calls.counts().unmap_calls; };
    EXPECT_FALSE(is_mapped());
    backend->state_hash();
    EXPECT_FALSE(is_mapped()) << "GL would draw from mapped memory";
    EXPECT_EQ(backend->extent().rogue, 0U);
    const Snapshot snapshot = backend->save();
    backend->restore(snapshot);
    EXPECT_FALSE(is_mapped());
    EXPECT_EQ(calls.counts().map_calls, 5);
    backend->step();
    backend->state_hash();
    EXPECT_TRUE(is_mapped()) << "the frame has not come to its end yet";
    EXPECT_EQ(calls.counts().map_calls, 6);
}

TEST_F(InteropBuffers, AreMappedTogetherAndUnregisteredBeforeGlFreesThem)
{
    const FailingCalls calls;
    {
        InteropFlakes memory(100, calls.calls());
        const Stream stream;
        for (int frame = 0; frame < 3; ++frame)
        {
            memory.map(stream);
            memory.unmap(stream);
        }
    }
    const FailingCalls::Counts counts = calls.counts();
    EXPECT_EQ(counts.registered, 2) << "once each, not once a frame";
    EXPECT_EQ(counts.map_calls, 3);
    EXPECT_EQ(counts.most_mapped_at_once, 2);
    EXPECT_EQ(counts.unmap_calls, 3);
    EXPECT_EQ(counts.unregistered, 2);
    EXPECT_EQ(counts.unregistered_after_gl_freed, 0);
}

}  // namespace

}  // namespace spindrift::gpu
