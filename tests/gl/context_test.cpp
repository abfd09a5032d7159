// SPDX-License-Identifier: MIT
#include "gl/context.h"

#include <GL/glew.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "core/error.h"
#include "gl/flake_buffers.h"
#include "gl/program.h"
#include "tests/gl/stage.h"

namespace spindrift::gl
{
namespace
{

TEST(Context, IsOpenGl45CoreWithoutDisplay)
{
    const ContextInfo& info = test_context().info();
    EXPECT_FALSE(info.renderer.empty());
    GLint profile = 0;
    GLint major = 0;
    GLint minor = 0;
    glGetIntegerv(GL_CONTEXT_PROFILE_MASK, &profile);
    glGetIntegerv(GL_MAJOR_VERSION, &major);
    glGetIntegerv(GL_MINOR_VERSION, &minor);
    EXPECT_TRUE(profile & GL_CONTEXT_CORE_PROFILE_BIT);
    EXPECT_GE(major * 10 + minor, 45);
}

TEST(Program, ErrorNamesTheFile)
{
    test_context();
    constexpr std::array<std::string_view, 2> files{"full_screen.vert", "tone.frag"};
    constexpr std::array<std::string_view, 1> broken{"vec4 nonsense"};
    try
    {
        make_program(files, broken);
        FAIL() << "a macro that breaks the source must not compile";
    }
    catch (const Error& error)
    {
        EXPECT_NE(std::string(error.what()).find("full_screen."), std::string::npos) << error.what();
        EXPECT_EQ(std::string(error.what()).find('\n'), std::string::npos) << "one line";
    }
    EXPECT_THROW(shader_source("nowhere.frag"), Error);
}

TEST(FlakeBuffers, ArraysAreAlignedApartAndWithinTheBudget)
{
    test_context();
    for (const std::size_t capacity : {0UL, 1UL, 17UL, 100'000UL})
    {
        const FlakeBuffers buffers(capacity);
        const FlakeView v = buffers.flakes();
        EXPECT_EQ(buffers.capacity(), capacity);
        const std::array<const void*, 11> arrays{v.x,      v.y,      v.z,      v.q1, v.q2,   v.q3,
                                                 v.slip_x, v.slip_y, v.slip_z, v.id, v.state};
        for (std::size_t i = 0; i < arrays.size(); ++i)
        {
            EXPECT_EQ(reinterpret_cast<std::uintptr_t>(arrays[i]) % 64, 0U);
            EXPECT_EQ(static_cast<const char*>(arrays[i]) - static_cast<const char*>(arrays[0]),
                      static_cast<std::ptrdiff_t>(i * buffers.array_stride() * 4));
        }
        EXPECT_GE(buffers.array_stride(), capacity);
        EXPECT_GE(static_cast<std::size_t>(buffers.draw_list().scratch - buffers.draw_list().pairs),
                  capacity);
        EXPECT_EQ(reinterpret_cast<std::uintptr_t>(buffers.draw_list().scratch) % 64, 0U);
        if (capacity >= 100'000)
        {
            EXPECT_LE(static_cast<double>(buffers.bytes()), 61.0 * static_cast<double>(capacity));
        }
    }
}

TEST(FlakeBuffers, MappedWritesReachTheBuffer)
{
    test_context();
    const std::string errors_before = Context::debug_errors();
    const FlakeBuffers buffers(1000);
    buffers.flakes().id[999] = 0xABCD1234U;
    buffers.draw_list().scratch[5] = 0x1122334455667788U;
    std::uint32_t id = 0;
    std::uint64_t pair = 0;
    const auto stride = static_cast<GLintptr>(buffers.array_stride() * 4);
    glGetNamedBufferSubData(buffers.state_buffer(), 9 * stride + 999 * 4, 4, &id);
    const GLintptr scratch = (buffers.draw_list().scratch - buffers.draw_list().pairs) * 8;
    glGetNamedBufferSubData(buffers.list_buffer(), scratch + 5 * 8, 8, &pair);
    EXPECT_EQ(id, 0xABCD1234U);
    EXPECT_EQ(pair, 0x1122334455667788U);
    EXPECT_EQ(Context::debug_errors(), errors_before);
}

TEST(FlakeBuffers, UnmappedOnesHoldZerosAndTakeTheSameLayout)
{
    test_context();
    const std::string errors_before = Context::debug_errors();
    const FlakeBuffers mapped(1000);
    const FlakeBuffers buffers(1000, FlakeBuffers::Access::unmapped);
    EXPECT_EQ(buffers.flakes().x, nullptr);
    EXPECT_EQ(buffers.draw_list().pairs, nullptr);
    EXPECT_EQ(buffers.bytes(), mapped.bytes());

    std::vector<std::uint32_t> state(11 * buffers.array_stride(), 1);
    std::vector<std::uint64_t> lists(2 * buffers.list_stride(), 1);
    EXPECT_EQ(state.size() * 4 + lists.size() * 8, buffers.bytes());
    glGetNamedBufferSubData(buffers.state_buffer(), 0, static_cast<GLsizeiptr>(state.size() * 4),
                            state.data());
    glGetNamedBufferSubData(buffers.list_buffer(), 0, static_cast<GLsizeiptr>(lists.size() * 8),
                            lists.data());
    EXPECT_THAT(state, testing::Each(0U));
    EXPECT_THAT(lists, testing::Each(0U));
    EXPECT_EQ(buffers.flakes_at(state.data()).state - state.data(),
              mapped.flakes().state - reinterpret_cast<std::uint32_t*>(mapped.flakes().x));
    EXPECT_EQ(buffers.draw_list_at(lists.data()).scratch - lists.data(),
              mapped.draw_list().scratch - mapped.draw_list().pairs);
    EXPECT_EQ(Context::debug_errors(), errors_before);
}

TEST(FlakeBuffers, TooLargeIsOneLine)
{
    test_context();
    try
    {
        const FlakeBuffers buffers(std::size_t{1} << 42);
        FAIL() << "four tera flakes cannot fit";
    }
    catch (const Error& error)
    {
        EXPECT_NE(std::string(error.what()).find("fewer particles"), std::string::npos);
    }
}

}  // namespace
}  // namespace spindrift::gl
