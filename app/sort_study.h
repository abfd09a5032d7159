// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "measure/pinned_threads.h"
#include "measure/sort_contender.h"

namespace spindrift::app
{

/// One sort on one input.
struct SortRow
{
    std::string input;      ///< "random", "camera path of town"
    std::string size;       ///< "65K"; of a camera path: the median
    std::size_t pairs = 0;  ///< median over the frames
    std::string sort;       ///< "radix/16-bit", "cuda/cub-radix"
    std::string backend;    ///< "cpu" or "cuda"
    int key_bits = 32;
    int passes = 0;          ///< a frame; 0: not a sort over frames
    std::size_t frames = 0;  ///< that were sorted
    double median_ms = 0, p95_ms = 0;
    double floor_ms = 0;        ///< median of a copy of the bytes that a radix sort of so many bits must move
    double bytes_per_pair = 0;  ///< that the sort itself moves; 0: depends on the data
    double share_under_10_ms = 0;
    double inversions = 0;                                 ///< against exact order; mean over the frames
    std::optional<double> image_error, worst_image_error;  ///< relative L2; none without pictures
};

/// The pairs of one frame (key << 32 | slot), slots ascending, with keys of 32, 24 and 16 bits.
struct KeysOfFrame
{
    std::vector<std::uint32_t>
        sources;  ///< as SortContender::follow takes them; empty: flakes kept their slots

    static constexpr std::array<int, 3> kBits{32, 24, 16};
    std::array<std::vector<std::uint64_t>, 3> pairs;

    const std::vector<std::uint64_t>& of(int bits) const
    {
        return pairs[static_cast<std::size_t>(4 - bits / 8)];
    }
};

/// Relative L2 of a picture drawn in this order against the one in exact order.
using PictureError =
    std::function<double(std::span<const std::uint64_t> order, std::span<const std::uint64_t> exact)>;

/// All wanted sorts of this machine on the frames of one input, one after the other in each frame, so that
/// what else the machine does hits all of them.
class SortStudy
{
  public:
    SortStudy(const measure::WantedSorts& wanted, int passes, std::size_t most_pairs, std::size_t slots);

    enum class Look
    {
        at_times,
        at_order_too,  ///< inversions and pictures
    };
    /// Throws std::logic_error if a sort that is exact gives another order.
    void add_frame(const KeysOfFrame& keys, SortStart start, Look look, const PictureError& error = {});

    std::vector<SortRow> rows(const std::string& input, const std::string& size = "") const;

  private:
    struct Series
    {
        std::vector<double> sort_ms, floor_ms, inversions, image_errors;
    };
    void look_at(measure::SortContender& sort, const KeysOfFrame& keys, const PictureError& error,
                 Series& series);

    int passes_;
    std::size_t slots_;
    measure::PinnedThreads pinned_;
    std::vector<std::unique_ptr<measure::SortContender>> sorts_;
    std::vector<Series> series_;
    std::vector<double> pairs_;
    std::vector<std::uint64_t> exact_;  ///< order of the frame at hand
};

/// "15K", "2M" or "1234"; thousands and millions.
std::string size_name(std::size_t n);

}  // namespace spindrift::app
