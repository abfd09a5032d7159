// SPDX-License-Identifier: MIT
#include "gl/flake_buffers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/error.h"
#include "gl/object.h"

namespace spindrift::gl
{

namespace
{

constexpr std::size_t kArrays = 11;
// Arrays are bound to shaders one by one; no driver asks for more than 256 bytes of alignment for that.
constexpr std::size_t kPaddingBytes = 256;

std::size_t padded(std::size_t bytes)
{
    return std::max(bytes + kPaddingBytes - 1, kPaddingBytes) / kPaddingBytes * kPaddingBytes;
}

struct MappedBuffer
{
    Buffer buffer;
    std::byte* memory = nullptr;

    MappedBuffer(std::size_t bytes, const char* what)
    {
        constexpr GLbitfield flags =
            GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
        while (glGetError() != GL_NO_ERROR)
        {
            // An older error must not be taken for this allocation's.
        }
        buffer = make_buffer(static_cast<GLsizeiptr>(bytes), nullptr, flags);
        if (glGetError() == GL_NO_ERROR)
            memory = static_cast<std::byte*>(
                glMapNamedBufferRange(buffer.name(), 0, static_cast<GLsizeiptr>(bytes), flags));
        if (memory == nullptr)
            throw Error(fmt::format("OpenGL cannot hold the {} ({:.1f} MiB); ask for fewer particles", what,
                                    static_cast<double>(bytes) / (1024.0 * 1024.0)));
    }
};

}  // namespace

struct FlakeBuffers::Impl
{
    std::size_t capacity;
    std::size_t stride;       // elements
    std::size_t list_stride;  // bytes
    MappedBuffer state;
    MappedBuffer list;

    explicit Impl(std::size_t n)
        : capacity(n),
          stride(padded(n * 4) / 4),
          list_stride(padded(n * 8)),
          state(kArrays * stride * 4, "flakes"),
          list(2 * list_stride, "draw list")
    {
        // Whoever reads a slot that nobody wrote must not meet a NaN.
        std::memset(state.memory, 0, kArrays * stride * 4);
        std::memset(list.memory, 0, 2 * list_stride);
    }

    float* floats(std::size_t array) const { return reinterpret_cast<float*>(state.memory) + array * stride; }
    std::uint32_t* words(std::size_t array) const
    {
        return reinterpret_cast<std::uint32_t*>(state.memory) + array * stride;
    }
};

FlakeBuffers::FlakeBuffers(std::size_t capacity) : impl_(std::make_unique<Impl>(capacity)) {}
FlakeBuffers::~FlakeBuffers() = default;

FlakeView FlakeBuffers::flakes() const
{
    const Impl& m = *impl_;
    return {m.floats(0), m.floats(1), m.floats(2), m.floats(3), m.floats(4), m.floats(5),
            m.floats(6), m.floats(7), m.floats(8), m.words(9),  m.words(10)};
}

DrawListView FlakeBuffers::draw_list() const
{
    return {reinterpret_cast<std::uint64_t*>(impl_->list.memory),
            reinterpret_cast<std::uint64_t*>(impl_->list.memory + impl_->list_stride)};
}

std::size_t FlakeBuffers::capacity() const
{
    return impl_->capacity;
}
std::size_t FlakeBuffers::bytes() const
{
    return kArrays * impl_->stride * 4 + 2 * impl_->list_stride;
}
std::uint32_t FlakeBuffers::state_buffer() const
{
    return impl_->state.buffer.name();
}
std::uint32_t FlakeBuffers::list_buffer() const
{
    return impl_->list.buffer.name();
}
std::size_t FlakeBuffers::array_stride() const
{
    return impl_->stride;
}

}  // namespace spindrift::gl
