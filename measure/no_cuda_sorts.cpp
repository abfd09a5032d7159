// SPDX-License-Identifier: MIT
#include "measure/cuda_sorts.h"

namespace spindrift::measure
{

std::vector<SortTraits> cuda_sorts()
{
    return {};
}

std::vector<std::unique_ptr<SortContender>> make_cuda_contenders(std::vector<SortTraits>, std::size_t,
                                                                 std::size_t)
{
    return {};
}

std::string no_cuda_because()
{
    return "this build has no CUDA backend";
}

}  // namespace spindrift::measure
