// SPDX-License-Identifier: MIT
#include "cuda/interop/sharing.h"
