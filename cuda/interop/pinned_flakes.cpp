// SPDX-License-Identifier: MIT
#include "cuda/interop/pinned_flakes.h"

#include <GL/glew.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "cuda/interop/gather.h"

namespace spindrift::gpu
{

namespace
{

// 1 MiB of page-locked memory a piece: long enough for a bus to run at speed, short enough to overlap.
constexpr std::size_t kPieceFlakes = std::size_t{1} << 16;
constexpr std::array<std::size_t, kDrawnArrays> kArrayOfGl{0, 1, 2, 9};  // of FlakeView

}  // namespace

PinnedFlakes::PinnedFlakes(std::size_t capacity)
    : device_(capacity),
      buffers_(capacity, gl::FlakeBuffers::Access::unmapped),
      piece_flakes_(std::min(capacity, kPieceFlakes))
{
    for (Piece& piece : pieces_)
    {
        piece.device = DeviceBuffer<std::uint32_t>(kDrawnArrays * piece_flakes_);
        piece.host = PinnedBuffer<std::uint32_t>(kDrawnArrays * piece_flakes_);
    }
    number_draw_lists();
}

std::size_t PinnedFlakes::bytes() const
{
    return device_.bytes() + buffers_.bytes() + pieces_.size() * 2 * pieces_[0].device.bytes();
}

void PinnedFlakes::number_draw_lists()
{
    std::vector<std::uint64_t> numbers(buffers_.list_stride());
    std::iota(numbers.begin(), numbers.end(), 0U);
    const auto bytes = static_cast<GLsizeiptr>(numbers.size() * sizeof(std::uint64_t));
    for (const GLintptr offset : {GLintptr{0}, GLintptr{bytes}})
        glNamedBufferSubData(buffers_.list_buffer(), offset, bytes, numbers.data());
}

void PinnedFlakes::fetch(StreamRef stream, Piece& piece, const FlakeView& flakes, const std::uint64_t* pairs,
                         std::size_t count)
{
    gather_drawn(stream, flakes, pairs, count, piece.device.data(), piece_flakes_);
    for (std::size_t array = 0; array < kDrawnArrays; ++array)
        copy_to_host(stream, piece.host.data() + array * piece_flakes_,
                     piece.device.data() + array * piece_flakes_, count);
    piece.copied.record(stream);
}

void PinnedFlakes::give_to_gl(const Piece& piece, std::size_t first, std::size_t count) const
{
    piece.copied.wait();
    for (std::size_t array = 0; array < kDrawnArrays; ++array)
        glNamedBufferSubData(buffers_.state_buffer(),
                             static_cast<GLintptr>((kArrayOfGl[array] * buffers_.array_stride() + first) * 4),
                             static_cast<GLsizeiptr>(count * 4), piece.host.data() + array * piece_flakes_);
}

void PinnedFlakes::hand_over(StreamRef stream, std::size_t, const DrawList& list)
{
    const FlakeAddresses at = device_.map(stream);
    const std::uint64_t* pairs = list.in_scratch ? at.draw_list.scratch : at.draw_list.pairs;
    const auto total = static_cast<std::size_t>(list.count);
    const auto count_from = [&](std::size_t first) { return std::min(piece_flakes_, total - first); };
    const auto piece_at = [&](std::size_t first) -> Piece&
    { return pieces_[first / piece_flakes_ % pieces_.size()]; };
    if (total == 0) return;
    fetch(stream, piece_at(0), at.flakes, pairs, count_from(0));
    for (std::size_t first = 0; first < total; first += piece_flakes_)
    {
        if (const std::size_t next = first + piece_flakes_; next < total)
            fetch(stream, piece_at(next), at.flakes, pairs + next, count_from(next));
        give_to_gl(piece_at(first), first, count_from(first));
    }
}

}  // namespace spindrift::gpu
