// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "app/backend_choice.h"
#include "app/engine.h"
#include "app/plan_log.h"
#include "app/stage_log.h"
#include "core/backend.h"
#include "core/world.h"
#include "gl/context.h"
#include "scene/scene.h"

namespace spindrift::app
{

/// Something that a run left out, and why.
struct Skip
{
    std::string what, why;
};

/// What a World lets the simulation leave out.
std::vector<Skip> simulation_skips(const World& world, std::uint32_t reorder_every_steps);

/// Flakes in the draw list, over the frames of a run.
struct DrawnFlakes
{
    SortSettings sort;
    std::vector<float> drawn, culled;  ///< one sample a frame
};

/// All that a run has to say about itself; what `--stats` writes.
struct RunReport
{
    BackendChoice choice;
    std::string backend;  ///< as it names itself
    std::string simd;
    int threads = 0;
    WayToGl way;
    std::optional<gl::ContextInfo> gl;
    std::string no_gl_because;

    FlakeCounts counts;
    FlakeExtent extent;
    std::uint64_t state_hash = 0, steps = 0, frames = 0;
    double wall_s = 0;
    bool interrupted = false;

    std::vector<StageSummary> stages;
    std::vector<PassHistory> passes;
    std::vector<Skip> skips;
    DrawnFlakes flakes;
    std::size_t buffer_bytes = 0;
    std::vector<std::string> outputs;
    std::string gl_errors;
};

/// emitted - (alive + left + landed + vanished); 0 unless the program is wrong.
std::int64_t imbalance(const FlakeCounts& counts);

/// JSON text, written aside and renamed. Throws Error if it cannot be written.
void write_report(const std::filesystem::path& file, const RunReport& report, const scene::Scene& scene,
                  const World& world);

/// "2a5f..." with 16 digits.
std::string hash_text(std::uint64_t hash);

}  // namespace spindrift::app
