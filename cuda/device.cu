// SPDX-License-Identifier: MIT
#include "cuda/device.h"

#include <cuda_runtime_api.h>

#include "cuda/check.h"

namespace spindrift::gpu
{

namespace
{

DeviceInfo describe(int ordinal, const cudaDeviceProp& properties)
{
    return {ordinal,          properties.name,           properties.major,
            properties.minor, properties.totalGlobalMem, properties.multiProcessorCount};
}

}  // namespace

Devices find_devices()
{
    Devices devices;
    cudaRuntimeGetVersion(&devices.runtime_version);
    cudaDriverGetVersion(&devices.driver_version);
    int count = 0;
    const cudaError_t code = cudaGetDeviceCount(&count);
    if (code != cudaSuccess) devices.none_because = error_text(code);
    for (int ordinal = 0; code == cudaSuccess && ordinal < count; ++ordinal)
    {
        cudaDeviceProp properties{};
        if (const cudaError_t asked = cudaGetDeviceProperties(&properties, ordinal); asked != cudaSuccess)
        {
            devices.none_because = error_text(asked);
            continue;
        }
        devices.list.push_back(describe(ordinal, properties));
    }
    cudaGetLastError();
    return devices;
}

void use_device(int ordinal)
{
    check(cudaSetDevice(ordinal), "cudaSetDevice");
}

DeviceInfo current_device()
{
    int ordinal = 0;
    cudaDeviceProp properties{};
    check(cudaGetDevice(&ordinal), "cudaGetDevice");
    check(cudaGetDeviceProperties(&properties, ordinal), "cudaGetDeviceProperties");
    return describe(ordinal, properties);
}

}  // namespace spindrift::gpu
