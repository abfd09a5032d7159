// SPDX-License-Identifier: MIT
#include "cuda/interop/probe.h"
#include "cuda/launch.cuh"

namespace spindrift::gpu
{

namespace
{

struct ProbeAnswerer
{
    std::uint32_t* words;

    __device__ void operator()(std::size_t i) const
    {
        words[i] = probe_answer(words[i], static_cast<std::uint32_t>(i));
    }
};

}  // namespace

void answer_probe(StreamRef stream, std::uint32_t* words)
{
    launch(stream, "interop probe", kProbeWords, ProbeAnswerer{words});
}

}  // namespace spindrift::gpu
