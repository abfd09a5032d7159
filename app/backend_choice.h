// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "app/engine.h"
#include "app/options.h"

namespace spindrift::app
{

struct BackendChoice
{
    std::string name;    ///< "cpu" or "cuda"
    std::string reason;  ///< why this one
};

/// A backend as it is asked for.
struct BackendWish
{
    std::string backend = "auto";   ///< auto, cpu or cuda
    std::string cpu_option = {};    ///< one that was given and only the CPU backend has; empty: none
    std::string cuda_option = {};   ///< likewise
    std::string key = "--backend";  ///< what the asker wrote before the name, for errors
};

BackendWish wish_of(const RunOptions& options);

/// From auto|cpu|cuda and the options that belong to one of them. Throws Error for one that this
/// build or machine has not got, and for options of another; never swaps silently.
BackendChoice choose_backend(const BackendWish& wish, const CudaSupport& cuda);

}  // namespace spindrift::app
