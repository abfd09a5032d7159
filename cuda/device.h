// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace spindrift::gpu
{

struct DeviceInfo
{
    int ordinal = 0;
    std::string name;  ///< "NVIDIA H100 80GB HBM3"
    int compute_major = 0, compute_minor = 0;
    std::size_t memory_bytes = 0;
    int multiprocessors = 0;
};

/// What this machine's CUDA runtime offers.
struct Devices
{
    std::vector<DeviceInfo> list;                 ///< empty: none, see `none_because`
    std::string none_because;                     ///< in the runtime's words
    int runtime_version = 0, driver_version = 0;  ///< 13000 is 13.0; driver 0: none
};

/// Never throws; leaves no error behind.
Devices find_devices();

/// All that the calling thread does with CUDA from now on is done there. Throws Error.
void use_device(int ordinal);
/// Where it is done. Throws Error if there is no device.
DeviceInfo current_device();

}  // namespace spindrift::gpu
