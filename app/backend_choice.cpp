// SPDX-License-Identifier: MIT
#include "app/backend_choice.h"

#include <fmt/format.h>

#include "core/error.h"

namespace spindrift::app
{

namespace
{

void require_cuda(const BackendWish& wish, const CudaSupport& cuda)
{
    const std::string others = fmt::format("use {0} cpu or {0} auto", wish.key);
    if (!cuda.built)
        throw Error(fmt::format("{} cuda: this build has no CUDA backend; {}", wish.key, others));
    if (cuda.devices.empty())
        throw Error(
            fmt::format("{} cuda: there is no CUDA device ({}); {}", wish.key, cuda.none_because, others));
}

BackendChoice choose_automatically(const BackendWish& wish, const CudaSupport& cuda)
{
    if (!wish.cpu_option.empty())
        return {"cpu", fmt::format("chosen by auto: {} is an option of the CPU backend", wish.cpu_option)};
    if (!cuda.built) return {"cpu", "chosen by auto: this build has the CPU backend only"};
    if (cuda.devices.empty())
        return {"cpu", fmt::format("chosen by auto: there is no CUDA device ({})", cuda.none_because)};
    return {"cuda", fmt::format("chosen by auto: there is a CUDA device, {}", cuda.devices.front())};
}

}  // namespace

BackendChoice choose_backend(const BackendWish& wish, const CudaSupport& cuda)
{
    BackendChoice choice;
    if (wish.backend == "cpu")
        choice = {"cpu", fmt::format("asked for with {} cpu", wish.key)};
    else if (wish.backend == "cuda")
    {
        require_cuda(wish, cuda);
        choice = {"cuda", fmt::format("asked for with {} cuda", wish.key)};
    }
    else if (wish.backend == "auto")
        choice = choose_automatically(wish, cuda);
    else
        throw Error(fmt::format("{} {}: is unknown; use auto, cpu or cuda", wish.key, wish.backend));

    if (choice.name == "cuda" && !wish.cpu_option.empty())
        throw Error(fmt::format("{} has no effect on the CUDA backend; leave it out or use {} cpu",
                                wish.cpu_option, wish.key));
    if (choice.name == "cpu" && !wish.cuda_option.empty())
        throw Error(fmt::format("{} has no effect on the CPU backend ({}); leave it out or use {} cuda",
                                wish.cuda_option, choice.reason, wish.key));
    return choice;
}

BackendWish wish_of(const RunOptions& options)
{
    return {.backend = options.backend,
            .cpu_option = options.threads ? "--threads"
                          : options.simd  ? "--simd"
                                          : "",
            .cuda_option = options.cuda_graph ? "--cuda-graph" : ""};
}

}  // namespace spindrift::app
