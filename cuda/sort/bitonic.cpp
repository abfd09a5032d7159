// SPDX-License-Identifier: MIT
#include "cuda/sort/network_steps.h"
#include "cuda/sort/strategy.h"

namespace spindrift::gpu
{

namespace
{

class Bitonic final : public DeviceSort
{
  public:
    std::uint64_t* sort(StreamRef stream, const SortJob& job) override
    {
        NetworkWalk walk(Network::bitonic);
        run_network(stream, walk, job.pairs, job.n, network_steps(Network::bitonic, job.n));
        return job.pairs;
    }
};

}  // namespace

namespace sorts
{

SortStrategy bitonic()
{
    return {.name = "bitonic",
            .about = "our own bitonic network over whole pairs, in tiles of 4096",
            .make = [](std::size_t) -> std::unique_ptr<DeviceSort> { return std::make_unique<Bitonic>(); },
            .max_key_bits = 32,
            .bytes_per_pair = [](std::size_t n, int, int)
            { return 16.0 * static_cast<double>(bitonic_sweeps(n)); }};
}

}  // namespace sorts

}  // namespace spindrift::gpu
