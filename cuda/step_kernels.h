// SPDX-License-Identifier: MIT
#pragma once

#include "core/advect_job.h"
#include "cuda/step_control.h"
#include "cuda/stream.h"

namespace spindrift::gpu
{

// The stages of a step, queued. None waits, allocates or needs to know a count. `job` is that of the World
// with the flakes' addresses.

/// Places the regions and decides whether emission needs the holes closed (StepControl::closing).
void begin_step(StreamRef stream, const StepAddresses& step);
/// Brings the wind to the step; nothing for a wind that stays as it is.
void blow(StreamRef stream, const StepAddresses& step);
/// Shares out and makes the flakes of the step.
void emit(StreamRef stream, const StepAddresses& step, const AdvectJob& job);
/// First the flakes that surely meet nothing, then the others, which `list` (a word a slot; overwritten)
/// names.
void advect(StreamRef stream, const StepAddresses& step, const AdvectJob& job, std::uint32_t* list);

enum class Closing
{
    if_many,  ///< by the rule of StepState
    always,   ///< before a re-ordering
};
/// Closes the accounts of the step and decides whether the holes are closed behind it.
void end_step(StreamRef stream, const StepAddresses& step, Closing closing);

}  // namespace spindrift::gpu
