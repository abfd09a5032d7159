// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "app/backend_choice.h"
#include "app/engine.h"
#include "app/frame_clock.h"
#include "app/interrupt.h"
#include "app/luminance_log.h"
#include "app/options.h"
#include "app/outputs.h"
#include "app/run_report.h"
#include "app/simulator.h"
#include "core/world.h"
#include "scene/mesh.h"
#include "scene/scene.h"

namespace spindrift::app
{

/// What a run starts from: read, validated, never changed afterwards.
struct RunInput
{
    scene::Scene scene;
    scene::Geometry geometry;
    World world;
    BackendChoice choice;
};

/// The state of a run that its three loops (simulate only, headless, window) share.
struct RunState
{
    const RunOptions& options;
    const RunInput& input;
    InterruptWatch interrupt;
    StageLog log;
    LuminanceLog luminance;
    RunReport report;
};

/// A simulator on the backend that was chosen, at the snapshot's state if one is to be loaded.
std::unique_ptr<Simulator> start_simulator(RunState& run, Drawing drawing);

/// Frame times of this run: from the end of the warm-up, or from where the snapshot goes on.
FrameClock make_clock(const RunInput& input, std::uint64_t steps_done);

/// Moves on until `steps` are complete, unless a signal asks for the end. True: arrived.
bool advance(RunState& run, Simulator& simulator, std::uint64_t steps);

/// The same with a progress bar, before the first frame.
void warm_up(RunState& run, Simulator& simulator, std::uint64_t steps);

/// Counts, hash and snapshot of the end of a run, into the report.
void conclude(RunState& run, Simulator& simulator);

void simulate_only(RunState& run);
void draw_headless(RunState& run, Outputs& outputs);

}  // namespace spindrift::app
