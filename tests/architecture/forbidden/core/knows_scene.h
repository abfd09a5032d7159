// SPDX-License-Identifier: MIT
#pragma once

#include "scene/mesh.h"
