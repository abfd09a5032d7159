// SPDX-License-Identifier: MIT
#pragma once

#include <GL/glew.h>
