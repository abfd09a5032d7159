// SPDX-License-Identifier: MIT
#include "app/backend_choice.h"

#include <fmt/format.h>

#include "core/error.h"

namespace spindrift::app
{

BackendChoice choose_backend(const std::string& asked)
{
    if (asked == "cpu") return {"cpu", "asked for with --backend cpu"};
    if (asked == "auto") return {"cpu", "chosen by auto: this build has the CPU backend only"};
    if (asked == "cuda")
        throw Error("--backend cuda: this build has no CUDA backend; use --backend cpu or --backend auto");
    throw Error(fmt::format("--backend {}: is unknown; use auto, cpu or cuda", asked));
}

}  // namespace spindrift::app
