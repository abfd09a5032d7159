// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "core/blown_wind.h"
#include "core/emission_ledger.h"
#include "core/encounter.h"
#include "core/regions.h"
#include "core/step_state.h"

namespace spindrift::gpu
{

/// How far the device is, in its memory. Kernels take their counts from here, so that the host need not know
/// them; the host gets `state` late. Counts are 32 bits wide, as the capacity is.
struct StepControl
{
    StepState state;
    std::uint32_t used = 0;        ///< StepState::used
    std::uint32_t made = 0;        ///< flakes of the step at hand …
    std::uint32_t first_slot = 0;  ///< … the slot of the first of them …
    std::uint32_t first_id = 0;    ///< … and its serial number
    std::uint32_t left_over = 0;   ///< flakes of the step at hand that may meet something
    std::uint32_t closing = 0;     ///< slots whose holes are being closed; 0: there is no need
    std::uint32_t kept = 0;        ///< of these live
    std::uint32_t visible = 0;     ///< flakes of the newest draw list
    unsigned long long left = 0, landed = 0, vanished = 0;  ///< of the step at hand
};

/// Device addresses of all that a step reads and writes beside the flakes.
struct StepAddresses
{
    StepControl* control = nullptr;
    EmissionLedger ledger;
    std::uint32_t* lost = nullptr;  ///< by emitter: flakes of the step at hand that it is to make up for
    RegionPlacer place;
    Region* regions_before = nullptr;  ///< where emission happens
    Region* regions_after = nullptr;   ///< where flakes must be at the end of the step
    BlownWind blown;                   ///< no states: the wind stays as it is
    double step_s = 0;
    std::uint64_t capacity = 0;
};

}  // namespace spindrift::gpu
