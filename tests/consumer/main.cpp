// SPDX-License-Identifier: MIT
#include <spindrift/simulation.h>

#include <cstdio>

int main(int argc, char** argv)
{
    if (argc != 2) return 2;
    try
    {
        spindrift::SimulationOptions options;
        options.particles = 1000;
        spindrift::Simulation simulation(argv[1], options);
        simulation.advance_to(0.5);
        const spindrift::FlakeCounts counts = simulation.counts();
        std::printf("%llu flakes alive after %.3f s\n", static_cast<unsigned long long>(counts.alive),
                    simulation.time_s());
        return counts.alive > 0 ? 0 : 1;
    }
    catch (const spindrift::Error& e)
    {
        std::fprintf(stderr, "%s\n", e.what());
        return 2;
    }
}
