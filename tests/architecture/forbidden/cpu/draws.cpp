// SPDX-License-Identifier: MIT
#include <GL/glew.h>
