// SPDX-License-Identifier: MIT
#include <thread>
