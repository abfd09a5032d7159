// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace spindrift::app
{

struct BackendChoice
{
    std::string name;    ///< "cpu"
    std::string reason;  ///< why this one
};

/// From --backend auto|cpu|cuda. Throws Error for one that this build has not got; never swaps silently.
BackendChoice choose_backend(const std::string& asked);

}  // namespace spindrift::app
