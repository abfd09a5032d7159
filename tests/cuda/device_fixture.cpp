// SPDX-License-Identifier: MIT
#include "tests/cuda/device_fixture.h"

#include <cstdlib>
#include <cstring>

#include "cuda/device.h"

namespace spindrift::gpu
{

void require_device()
{
    const Devices devices = find_devices();
    if (!devices.list.empty()) return;
    const char* required = std::getenv("SPINDRIFT_REQUIRE_CUDA");
    if (required != nullptr && std::strcmp(required, "1") == 0)
        FAIL() << "SPINDRIFT_REQUIRE_CUDA=1, but no CUDA device: " << devices.none_because;
    GTEST_SKIP() << "no CUDA device: " << devices.none_because;
}

}  // namespace spindrift::gpu
