// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace spindrift_test
{

/// Arguments and results of one operation as raw 32-bit patterns; n is a multiple of 16.
struct OperationData
{
    const std::uint32_t *a, *b, *c;
    std::uint32_t* out;
    int n;
};

struct Operation
{
    const char* name;
    void (*run)(const OperationData&);
};

/// Every operation of core/number.h and function of core/math.h, core/philox.h and core/snow.h on one number
/// type. The lists have the same operations in the same order, ended by a null name.
const Operation* scalar_operations();
const Operation* avx2_operations();
const Operation* avx512_operations();

}  // namespace spindrift_test
