// SPDX-License-Identifier: MIT
#include "app/machine.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string_view>
#include <thread>

#include <fmt/format.h>
#include <unistd.h>

#include "core/error.h"

namespace spindrift::app
{

namespace
{

std::string_view environment(const char* name)
{
    const char* value = std::getenv(name);
    return value ? value : "";
}

}  // namespace

int usable_threads(const cpu::CpuOptions& options)
{
    return options.threads > 0 ? options.threads : static_cast<int>(std::thread::hardware_concurrency());
}

std::string used_simd(const cpu::CpuOptions& options)
{
    return cpu::simd_name(options.simd == cpu::Simd::automatic ? cpu::available_simd().back() : options.simd);
}

cpu::Simd parse_simd(const std::string& word)
{
    if (word == "auto") return cpu::Simd::automatic;
    if (word == "scalar") return cpu::Simd::scalar;
    if (word == "avx2") return cpu::Simd::avx2;
    if (word == "avx512") return cpu::Simd::avx512;
    throw Error(fmt::format("simd = {}: is unknown; use auto, scalar, avx2 or avx512", word));
}

std::string processor_name()
{
    std::ifstream file("/proc/cpuinfo");
    for (std::string line; std::getline(file, line);)
        if (line.rfind("model name", 0) == 0 && line.find(": ") != std::string::npos)
            return line.substr(line.find(": ") + 2);
    return "unknown";
}

std::filesystem::path find_program(const std::string& name)
{
    std::istringstream folders{std::string(environment("PATH"))};
    for (std::string folder; std::getline(folders, folder, ':');)
    {
        const std::filesystem::path candidate = std::filesystem::path(folder) / name;
        if (!folder.empty() && access(candidate.c_str(), X_OK) == 0) return candidate;
    }
    return {};
}

bool has_display()
{
    return !environment("DISPLAY").empty() || !environment("WAYLAND_DISPLAY").empty();
}

void require_display()
{
    if (has_display()) return;
    throw Error(
        "there is no display for a window (neither DISPLAY nor WAYLAND_DISPLAY is set); "
        "add --headless, with --out FILE for pictures");
}

}  // namespace spindrift::app
