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

/// From --backend auto|cpu|cuda and the options that belong to one of them. Throws Error for one that this
/// build or machine has not got, and for options of another; never swaps silently.
BackendChoice choose_backend(const RunOptions& options, const CudaSupport& cuda);

}  // namespace spindrift::app
