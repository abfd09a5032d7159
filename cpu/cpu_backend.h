// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "core/backend.h"
#include "core/world.h"

namespace spindrift::cpu
{

/// Which compiled variant of the kernels runs. All give the same bits.
enum class Simd
{
    automatic,   ///< the widest that this processor has
    scalar,      ///< for any x86-64; fused multiply-adds are calls
    scalar_fma,  ///< one flake at a time, compiled for AVX2 with FMA: what the packs are measured against
    avx2,
    avx512,
};

/// Names of the variants that this processor can run, narrowest first.
std::vector<Simd> available_simd();
std::string simd_name(Simd simd);

struct CpuOptions
{
    int threads = 0;  ///< 0: one per core that this process may use
    Simd simd = Simd::automatic;
    /// Puts the flakes in the order of the wind cells that they read after every so many steps; 0: never.
    /// Without a wind grid there is nothing to order by. The results are the same.
    std::uint32_t reorder_every_steps = 0;
};

/// The CPU implementation of Backend: TBB over chunks, SIMD inside. It works on memory that the caller owns
/// and that must outlive it: `flakes` and `draw_list` with room for world.capacity elements in each array.
/// Nothing is allocated per step. Throws Error if the asked variant cannot run here.
std::unique_ptr<Backend> make_cpu_backend(const World& world, const FlakeView& flakes,
                                          const DrawListView& draw_list, const CpuOptions& options);

/// Host memory for runs without GL; 64-byte aligned, freed with it.
class HostFlakes
{
  public:
    explicit HostFlakes(std::size_t capacity);
    ~HostFlakes();
    HostFlakes(HostFlakes&&) noexcept;
    HostFlakes& operator=(HostFlakes&&) noexcept;
    FlakeView flakes() const;
    DrawListView draw_list() const;

  private:
    struct Arrays;
    std::unique_ptr<Arrays> arrays_;
};

}  // namespace spindrift::cpu
