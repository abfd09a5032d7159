// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "core/error.h"
#include "core/flake.h"

namespace spindrift
{

enum class Pictures
{
    off,  ///< simulate only; no GL is touched
    on,   ///< a headless GL context is made and draw() works
};

struct SimulationOptions
{
    /// cpu, cuda, or auto: cuda where this build and machine have it. The results are the same.
    std::string backend = "cpu";
    int threads = 0;            ///< of the CPU; 0: one per core that this process may use
    std::string simd = "auto";  ///< of the CPU; auto, scalar, avx2, avx512: the results are the same
    /// Capacity instead of the scene's; bursts and rates are scaled with it.
    std::optional<std::uint64_t> particles = {};
    std::optional<std::uint64_t> seed = {};            ///< instead of the scene's
    std::optional<int> width_px = {}, height_px = {};  ///< of the picture, instead of the scene's
    Pictures pictures = Pictures::off;
};

/// A scene and its flakes, for programs that embed Spindrift. Fixed steps; it owns no clock and no window.
/// With pictures on, use it in the thread that made it. Bad input throws Error, whose what() is one line that
/// a person can act on.
class Simulation
{
  public:
    explicit Simulation(const std::filesystem::path& scene, const SimulationOptions& options = {});
    ~Simulation();
    Simulation(Simulation&&) noexcept;
    Simulation& operator=(Simulation&&) noexcept;

    void step();
    /// Steps until the simulated time is at least `time_s` less one step; never backwards.
    void advance_to(double time_s);

    std::string backend() const;  ///< "cpu (avx512, 2 threads)"
    double step_s() const;
    double time_s() const;
    std::uint64_t steps() const;
    FlakeCounts counts() const;
    /// Depends on scene, seed and number of steps only; not on backend, threads, SIMD or machine.
    std::uint64_t state_hash() const;

    /// Slots [0, slots_used()) hold flakes, those whose Fate is not `alive` are holes; metres from the lower
    /// corner of the domain, z up. On the CPU the live arrays: read them between steps. On a device a copy of
    /// the living flakes that this call makes, which holds until the next.
    FlakeView flakes() const;
    std::size_t slots_used() const;

    void save(const std::filesystem::path& snapshot) const;
    void load(const std::filesystem::path& snapshot);

    /// Draws the flakes as they are, seen by the scene's camera at the simulated time. Needs Pictures::on.
    void draw();
    /// What was drawn last: .png (display) or .exr (linear), written aside and renamed.
    void write_picture(const std::filesystem::path& file) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

}  // namespace spindrift
