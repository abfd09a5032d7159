// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>

#include "cpu/cpu_backend.h"

namespace spindrift::app
{

/// Threads that the simulation runs on with these options.
int usable_threads(const cpu::CpuOptions& options);

/// Name of the SIMD variant that runs with these options.
std::string used_simd(const cpu::CpuOptions& options);

/// From "auto", "scalar", "avx2" or "avx512". Throws Error for another word.
cpu::Simd parse_simd(const std::string& word);

/// As the processor calls itself; "unknown" where /proc does not say.
std::string processor_name();

/// Where a program would be started from; empty if it is not on the PATH.
std::filesystem::path find_program(const std::string& name);

/// Whether an X11 or Wayland display is named in the environment.
bool has_display();

/// Throws Error that names --headless if there is none.
void require_display();

}  // namespace spindrift::app
