// SPDX-License-Identifier: MIT
#include "cpu/pack.h"

#define SPINDRIFT_TEST_REAL float
#define SPINDRIFT_TEST_LIST scalar_operations
#include "number_operations.inl"
