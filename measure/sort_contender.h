// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "core/kept_order.h"
#include "core/sort_network.h"

namespace spindrift::measure
{

/// What a sort says of itself.
struct SortTraits
{
    std::string name;      ///< "radix", "radix/16-bit", "cuda/cub-radix"
    std::string strategy;  ///< "radix"; as scenes name it
    std::string backend;   ///< "cpu" or "cuda"
    std::string about;
    int key_bits = 32;
    bool library = false;            ///< not our own
    bool exact = true;               ///< at its key bits
    std::optional<Network> network;  ///< set: a sort over frames, not exact
    /// Bytes a pair that its passes move, of n pairs with so many passes a frame; 0: depends on the data.
    std::function<double(std::size_t n, int passes)> bytes_per_pair;
};

/// One sort, with its memory, to be fed and timed again and again.
class SortContender
{
  public:
    explicit SortContender(SortTraits traits) : traits_(std::move(traits)) {}
    virtual ~SortContender() = default;
    const SortTraits& traits() const { return traits_; }

    /// Brings the pairs, with keys of traits().key_bits, to where they are sorted.
    virtual void load(std::span<const std::uint64_t> pairs) = 0;
    /// Milliseconds of the sort of what was loaded last; on a device between two of its events. `passes` and
    /// `start` are for sorts over frames.
    virtual double sort_ms(int passes, SortStart start) = 0;
    /// Since the last sort flakes have got other slots: slot i stands for what slot sources[i] stood for, or
    /// for a new flake if that is kNoRank; slots beyond are free. Only sorts over frames care.
    virtual void follow(std::span<const std::uint32_t> /*sources*/) {}
    /// The outcome, until the next call of anything.
    virtual std::span<const std::uint64_t> result() = 0;
    /// Milliseconds of a plain copy in the same memory that reads and writes so many bytes for each pair that
    /// is loaded. Spoils them.
    virtual double copy_ms(double bytes_per_pair) = 0;

  private:
    SortTraits traits_;
};

struct WantedSorts
{
    bool cpu = true, cuda = true;
    bool unsorted = false;                ///< "none" too: the order of slots
    std::vector<std::string> strategies;  ///< empty: all
};

/// All sorts of this machine, those that can at fewer than 32 bits too, for at most `pairs` pairs whose slots
/// are below `slots`. They share their arrays: load, sort and look at one after the other. CPU sorts expect
/// PinnedThreads to be alive.
std::vector<std::unique_ptr<SortContender>> make_contenders(const WantedSorts& wanted, std::size_t pairs,
                                                            std::size_t slots);

/// The same without memory; order and names are those of make_contenders.
std::vector<SortTraits> list_sorts(const WantedSorts& wanted);

/// Why there is no CUDA device to sort on; empty if there is one.
std::string no_cuda_because();

/// Ranks by slot, moved as SortContender::follow says.
std::vector<std::uint32_t> moved_ranks(std::span<const std::uint32_t> ranks,
                                       std::span<const std::uint32_t> sources);

/// What a radix sort with digits of 8 bits must move: all pairs read once to count, then read and written
/// once a digit. Pairs are 8 bytes.
inline double floor_bytes_per_pair(int key_bits)
{
    return 8.0 + 16.0 * ((key_bits + 7) / 8);
}

}  // namespace spindrift::measure
