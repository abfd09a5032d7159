// SPDX-License-Identifier: MIT
#include "scene/scene.h"
