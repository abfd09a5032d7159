// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include "core/backend.h"
#include "core/world.h"

namespace spindrift::parity
{

/// A backend with the memory that it works on.
class BackendRun
{
  public:
    virtual ~BackendRun() = default;
    virtual Backend& backend() = 0;
    /// The pairs of a list that prepare() returned.
    virtual std::vector<std::uint64_t> pairs(const DrawList& list) = 0;
    /// Serial numbers by slot, of the slots in use.
    virtual std::vector<std::uint32_t> ids() = 0;
    /// Overwrites an element of one of the floats of FlakeView.
    virtual void put(float* FlakeView::*array, std::size_t slot, float value) = 0;
};

/// One way to run a World.
struct Variant
{
    std::string name;
    std::function<std::unique_ptr<BackendRun>(const World&)> make;
    std::uint32_t reorder_every_steps = 0;
};

inline std::ostream& operator<<(std::ostream& out, const Variant& variant)
{
    return out << variant.name;
}

/// What this program tests: the CPU's variants, or the CUDA device's.
std::vector<Variant> variants();

/// The oracle: one thread, scalar, never re-ordered.
std::unique_ptr<BackendRun> make_oracle(const World& world);
std::unique_ptr<BackendRun> make_cpu_run(const World& world, int threads, std::uint32_t reorder_every_steps);

/// Skips or fails where the variants cannot run here; empty: they can.
std::string cannot_run_because();

}  // namespace spindrift::parity
