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

struct FlakeBuffer
{
    Buffer buffer;
    std::byte* memory = nullptr;  ///< null if unmapped

    // All zero at first: whoever reads a slot that nobody wrote must not meet a NaN.
    FlakeBuffer(std::size_t bytes, FlakeBuffers::Access access, const char* what)
    {
        constexpr GLbitfield mapped =
            GL_MAP_READ_BIT | GL_MAP_WRITE_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;
        while (glGetError() != GL_NO_ERROR)
        {
            // An older error must not be taken for this allocation's.
        }
        const bool map = access == FlakeBuffers::Access::mapped;
        const auto size = static_cast<GLsizeiptr>(bytes);
        buffer = map ? make_buffer(size, nullptr, mapped) : make_lent_buffer(size, nullptr);
        bool have = glGetError() == GL_NO_ERROR;
        if (have && map)
        {
            memory = static_cast<std::byte*>(glMapNamedBufferRange(buffer.name(), 0, size, mapped));
            have = memory != nullptr;
            if (have) std::memset(memory, 0, bytes);
        }
        else if (have)
        {
            glClearNamedBufferData(buffer.name(), GL_R32UI, GL_RED_INTEGER, GL_UNSIGNED_INT, nullptr);
            // Without it, what was written next was lost at times on a GPU (NVIDIA 580).
            glFinish();
            have = glGetError() == GL_NO_ERROR;
        }
        if (!have)
            throw Error(fmt::format("OpenGL cannot hold the {} ({:.1f} MiB); ask for fewer particles", what,
                                    static_cast<double>(bytes) / (1024.0 * 1024.0)));
    }
};

}  // namespace

struct FlakeBuffers::Impl
{
    std::size_t capacity;
    Access access;
    std::size_t stride;       // elements
    std::size_t list_stride;  // elements
    FlakeBuffer state;
    FlakeBuffer list;

    Impl(std::size_t n, Access how)
        : capacity(n),
          access(how),
          stride(padded(n * 4) / 4),
          list_stride(padded(n * 8) / 8),
          state(kArrays * stride * 4, how, "flakes"),
          list(2 * list_stride * 8, how, "draw list")
    {
    }
};

FlakeBuffers::FlakeBuffers(std::size_t capacity, Access access)
    : impl_(std::make_unique<Impl>(capacity, access))
{
}
FlakeBuffers::~FlakeBuffers() = default;

FlakeBuffers::Access FlakeBuffers::access() const
{
    return impl_->access;
}

FlakeView FlakeBuffers::flakes_at(void* state) const
{
    if (state == nullptr) return {};
    const auto words = [&](std::size_t array)
    { return static_cast<std::uint32_t*>(state) + array * impl_->stride; };
    const auto floats = [&](std::size_t array) { return reinterpret_cast<float*>(words(array)); };
    return {floats(0), floats(1), floats(2), floats(3), floats(4), floats(5),
            floats(6), floats(7), floats(8), words(9),  words(10)};
}

DrawListView FlakeBuffers::draw_list_at(void* lists) const
{
    if (lists == nullptr) return {};
    auto* pairs = static_cast<std::uint64_t*>(lists);
    return {pairs, pairs + impl_->list_stride};
}

FlakeView FlakeBuffers::flakes() const
{
    return flakes_at(impl_->state.memory);
}
DrawListView FlakeBuffers::draw_list() const
{
    return draw_list_at(impl_->list.memory);
}

std::size_t FlakeBuffers::capacity() const
{
    return impl_->capacity;
}
std::size_t FlakeBuffers::bytes() const
{
    return kArrays * impl_->stride * 4 + 2 * impl_->list_stride * 8;
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
std::size_t FlakeBuffers::list_stride() const
{
    return impl_->list_stride;
}

}  // namespace spindrift::gl
