// SPDX-License-Identifier: MIT
#include "cpu/pack.h"

#define SPINDRIFT_TEST_REAL spindrift::cpu::Avx512Real
#define SPINDRIFT_TEST_LIST avx512_operations
#include "number_operations.inl"
