// SPDX-License-Identifier: MIT
#include "cuda/interop/probe.h"

#include <fmt/format.h>

#include <array>

#include "core/error.h"
#include "cuda/interop/registered_buffers.h"
#include "gl/object.h"

namespace spindrift::gpu
{

namespace
{

using Words = std::array<std::uint32_t, kProbeWords>;

std::string first_difference(const Words& read)
{
    for (std::uint32_t i = 0; i < kProbeWords; ++i)
    {
        const std::uint32_t expected = probe_answer(probe_seed(i), i);
        if (read[i] != expected)
            return fmt::format("the probe came back wrong: word {} is {:#010x} instead of {:#010x}", i,
                               read[i], expected);
    }
    return {};
}

std::string try_buffer(const GraphicsCalls& calls)
{
    Words words{};
    for (std::uint32_t i = 0; i < kProbeWords; ++i) words[i] = probe_seed(i);
    const gl::Buffer buffer = gl::make_lent_buffer(sizeof(words), words.data());
    const std::array<GLuint, 1> names{buffer.name()};
    const Stream stream;
    RegisteredBuffers registered(names, calls);
    registered.map(stream);
    answer_probe(stream, static_cast<std::uint32_t*>(registered.address(0)));
    registered.unmap(stream);
    stream.ref().wait();  // for what the kernel itself reports
    glGetNamedBufferSubData(buffer.name(), 0, sizeof(words), words.data());
    return first_difference(words);
}

}  // namespace

std::string probe_interop(const GraphicsCalls& calls)
{
    std::string failure;
    try
    {
        failure = try_buffer(calls);
    }
    catch (const Error& error)
    {
        failure = error.what();
    }
    cudaGetLastError();
    while (glGetError() != GL_NO_ERROR)
    {
        // A driver that cannot share may complain to GL, too.
    }
    return failure;
}

}  // namespace spindrift::gpu
