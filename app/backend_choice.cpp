// SPDX-License-Identifier: MIT
#include "app/backend_choice.h"

#include <fmt/format.h>

#include "core/error.h"

namespace spindrift::app
{

namespace
{

std::string cpu_option(const RunOptions& options)
{
    return options.threads ? "--threads" : options.simd ? "--simd" : "";
}

void require_cuda(const CudaSupport& cuda)
{
    if (!cuda.built)
        throw Error("--backend cuda: this build has no CUDA backend; use --backend cpu or --backend auto");
    if (cuda.devices.empty())
        throw Error(
            fmt::format("--backend cuda: there is no CUDA device ({}); use --backend cpu or --backend auto",
                        cuda.none_because));
}

BackendChoice choose_automatically(const RunOptions& options, const CudaSupport& cuda)
{
    if (const std::string option = cpu_option(options); !option.empty())
        return {"cpu", fmt::format("chosen by auto: {} is an option of the CPU backend", option)};
    if (!cuda.built) return {"cpu", "chosen by auto: this build has the CPU backend only"};
    if (cuda.devices.empty())
        return {"cpu", fmt::format("chosen by auto: there is no CUDA device ({})", cuda.none_because)};
    return {"cuda", fmt::format("chosen by auto: there is a CUDA device, {}", cuda.devices.front())};
}

}  // namespace

BackendChoice choose_backend(const RunOptions& options, const CudaSupport& cuda)
{
    BackendChoice choice;
    if (options.backend == "cpu")
        choice = {"cpu", "asked for with --backend cpu"};
    else if (options.backend == "cuda")
    {
        require_cuda(cuda);
        choice = {"cuda", "asked for with --backend cuda"};
    }
    else if (options.backend == "auto")
        choice = choose_automatically(options, cuda);
    else
        throw Error(fmt::format("--backend {}: is unknown; use auto, cpu or cuda", options.backend));

    if (const std::string option = cpu_option(options); choice.name == "cuda" && !option.empty())
        throw Error(
            fmt::format("{} has no effect on the CUDA backend; leave it out or use --backend cpu", option));
    if (choice.name == "cpu" && options.cuda_graph)
        throw Error(fmt::format(
            "--cuda-graph has no effect on the CPU backend ({}); leave it out or use --backend cuda",
            choice.reason));
    return choice;
}

}  // namespace spindrift::app
