// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "app/backend_choice.h"
#include "app/build_info.h"
#include "app/commands.h"
#include "app/exit_codes.h"
#include "app/machine.h"
#include "app/sort_choice.h"
#include "core/error.h"
#include "gl/context.h"

namespace spindrift::app
{

namespace
{

void line(const char* what, const std::string& value)
{
    fmt::print("{:<13}{}\n", what, value);
}

std::string simd_variants()
{
    std::string text;
    for (const cpu::Simd simd : cpu::available_simd())
        text += (text.empty() ? "" : ", ") + cpu::simd_name(simd);
    return fmt::format("{} (auto runs {}; the results are the same)", text, used_simd({}));
}

std::string sorts(const std::string& backend)
{
    std::string text;
    for (const SortName& sort : sorts_of(backend))
        text += fmt::format("{}{}", text.empty() ? "" : ", ", sort.name);
    return fmt::format("{} (auto is {})", text, choose_sort(backend, "auto"));
}

void print_cuda(const CudaSupport& cuda)
{
    if (!cuda.built) return line("CUDA", "none in this build");
    if (cuda.devices.empty()) line("CUDA", fmt::format("no device: {}", cuda.none_because));
    for (std::size_t d = 0; d < cuda.devices.size(); ++d)
        line(d == 0 ? "CUDA" : "", fmt::format("device {}: {}", d, cuda.devices[d]));
    line("", cuda.versions);
}

void print_interop(const CudaSupport& cuda)
{
    line("interop",
         "cpu: GL's buffers, which the CPU backend writes in place (--interop off copies instead)");
    if (cuda.devices.empty()) return;
    const WayToGl way = cuda_way_to_gl();
    line("", fmt::format("cuda: {} ({})", way.memory, way.because));
}

void print_gl(const CudaSupport& cuda)
{
    std::unique_ptr<gl::Context> context;
    try
    {
        context = make_drawing_context();
    }
    catch (const Error& e)
    {
        line("GL", fmt::format("none: {}", e.what()));
        return line("interop", "none without GL; --headless without --out simulates all the same");
    }
    const gl::ContextInfo& gl = context->info();
    line("GL", fmt::format("{} ({})", gl.renderer, gl.software ? "software" : "hardware"));
    line("", fmt::format("{}, {}, through {}", gl.version, gl.vendor, gl.platform));
    print_interop(cuda);
}

}  // namespace

int info()
{
    const CudaSupport cuda = cuda_support();
    const BackendChoice choice = choose_backend({}, cuda);
    line("spindrift", fmt::format("{} ({}, {}{}{})", kVersion, kBuildType, kCompiler,
                                  *kSanitizers ? ", sanitizers " : "", kSanitizers));
    line("backend", fmt::format("{} ({})", choice.name, choice.reason));
    line("processor", processor_name());
    line("threads", fmt::format("{}", usable_threads({})));
    line("SIMD", simd_variants());
    line("sorts", sorts(choice.name));
    print_cuda(cuda);
    print_gl(cuda);
    line("display", has_display() ? "yes" : "none (DISPLAY and WAYLAND_DISPLAY are unset): use --headless");
    const auto ffmpeg = find_program("ffmpeg");
    line("video", ffmpeg.empty() ? "no ffmpeg on the PATH: --out x.mp4 is not possible" : ffmpeg.string());
    line("libraries", kLibraries);
    return kOk;
}

}  // namespace spindrift::app
