// SPDX-License-Identifier: MIT
#pragma once

// The SIMD packs of float that core/'s templates run on, as many as the flags of this translation unit allow.
//
// A pack is one register with the operations of core/number.h as friends. They are written on the intrinsics
// and not on a library of packs because (1) every operation must be IEEE exact, (2) nothing may stay out of
// line: kernels are compiled once per instruction set, and the linker keeps one copy of an inline function,
// whichever set it was compiled for. docs/decisions/001-own-simd-packs.md.

#include "core/math.h"

#if defined(__AVX2__) && defined(__FMA__)
#include "cpu/pack_avx2.h"
#endif
#if defined(__AVX512F__) && defined(__AVX512DQ__)
#include "cpu/pack_avx512.h"
#endif
