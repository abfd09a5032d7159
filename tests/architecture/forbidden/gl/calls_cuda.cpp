// SPDX-License-Identifier: MIT
#include <cuda_gl_interop.h>
