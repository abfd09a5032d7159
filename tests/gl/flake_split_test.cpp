// SPDX-License-Identifier: MIT
#include "gl/flake_split.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

#include "gl/frame_constants.h"
#include "tests/gl/stage.h"

namespace spindrift::gl
{
namespace
{

struct Draw
{
    GLuint count, instances, first, base;
    bool operator==(const Draw&) const = default;
};

template <class T>
Buffer bound(const std::vector<T>& data, GLuint binding)
{
    Buffer buffer = make_buffer(static_cast<GLsizeiptr>(data.size() * sizeof(T)), data.data(), 0);
    glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, buffer.name());
    return buffer;
}

TEST(FlakeSplit, FindsTheFirstFlakeWithinTheBorder)
{
    test_context();
    const std::string errors_before = Context::debug_errors();
    const FlakeSplit split;
    // Flake k of the list is 100 - k metres away, at slot 99 - k; its key is of no concern.
    std::vector<float> x;
    std::vector<std::uint64_t> pairs;
    for (std::uint32_t k = 0; k < 100; ++k)
    {
        x.push_back(static_cast<float>(k + 1) + 10.0F);
        pairs.push_back(std::uint64_t{0xFFFF0000U} << 32 | (99 - k));
    }
    const Buffer xs = bound(x, kXArray);
    const Buffer ys = bound(std::vector<float>(100, 20.0F), kYArray);
    const Buffer zs = bound(std::vector<float>(100, 30.0F), kZArray);
    const Buffer list = bound(pairs, kDrawList);

    for (const GLuint count : {0U, 1U, 2U, 63U, 100U})
        for (const double border_m : {0.5, 1.0, 37.0, 37.5, 99.0, 99.5, 100.0, 1e6})
        {
            split.search(static_cast<GLsizei>(count), {10, 20, 30}, border_m);
            GLint name = 0;
            glGetIntegerv(GL_DRAW_INDIRECT_BUFFER_BINDING, &name);
            std::array<Draw, 2> draws{};
            glGetNamedBufferSubData(static_cast<GLuint>(name), 0, sizeof(draws), draws.data());
            GLuint beyond = 0;
            while (beyond < count && 100.0 - beyond > border_m) ++beyond;
            EXPECT_EQ(draws[0], (Draw{beyond, 1, 0, 0})) << count << " " << border_m;
            EXPECT_EQ(draws[1], (Draw{count - beyond, 1, beyond, 0})) << count << " " << border_m;
        }
    EXPECT_EQ(Context::debug_errors(), errors_before);
}

}  // namespace
}  // namespace spindrift::gl
