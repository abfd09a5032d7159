// SPDX-License-Identifier: MIT
#include "cpu/pack.h"

#define SPINDRIFT_TEST_REAL spindrift::cpu::Avx2Real
#define SPINDRIFT_TEST_LIST avx2_operations
#include "number_operations.inl"
