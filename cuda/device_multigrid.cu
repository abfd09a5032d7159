// SPDX-License-Identifier: MIT
#include "cuda/device_multigrid.h"

#include "cuda/launch.cuh"
#include "cuda/poisson_kernels.cuh"

namespace spindrift::gpu
{

namespace
{

struct SmoothFromZero
{
    PaddedBox box;
    SmootherFromZero smoother;
    __device__ void operator()(int x, int y, int z) const { smoother(box.index(x, y, z), x + y + z); }
};

DeviceBuffer<float> zeros(std::size_t n)
{
    DeviceBuffer<float> buffer(n);
    buffer.fill_now(0);
    return buffer;
}

}  // namespace

DeviceMultigrid::Level::Level(StreamRef stream, const PoissonLevel& grid) : box(grid.box), halved(grid.halved)
{
    const auto n = static_cast<std::size_t>(box.count());
    for (int a = 0; a < 3; ++a)
    {
        face[a] = DeviceBuffer<float>(grid.face[a]);
        open[a] = DeviceBuffer<float>(grid.open[a]);
        toward[a] = DeviceBuffer<float>(grid.toward[a]);
    }
    for (DeviceBuffer<float>* array : {&inverse_diagonal, &u, &b, &r}) *array = zeros(n);
    check(cudaDeviceSynchronize(), "cudaDeviceSynchronize");  // memset of the default stream
    const DiagonalInverter invert{coefficients(), inverse_diagonal.data()};
    for_each_cell(stream, "invert diagonal", box, AtIndex<DiagonalInverter>{box, invert});
}

DeviceMultigrid::DeviceMultigrid(StreamRef stream, const std::vector<PoissonLevel>& levels)
{
    for (const PoissonLevel& level : levels) levels_.emplace_back(stream, level);
    stream.wait();
}

void DeviceMultigrid::cycle(StreamRef stream)
{
    if (!cycle_) cycle_.emplace(stream, [&] { queue_cycle(stream, 0); });
    cycle_->launch(stream);
}

void DeviceMultigrid::smooth(StreamRef stream, const Level& level, int colour)
{
    smooth_colour(stream, level.box,
                  Smoother<float>{level.coefficients(), level.inverse_diagonal.data(), level.b.data(),
                                  level.u.data(), 1.0F},
                  colour);
}

void DeviceMultigrid::smooth_from_zero(StreamRef stream, const Level& level)
{
    for_each_cell(stream, "smooth from zero", level.box,
                  SmoothFromZero{level.box, {level.inverse_diagonal.data(), level.b.data(), level.u.data()}});
}

void DeviceMultigrid::take_residual(StreamRef stream, const Level& level)
{
    const ResidualTaker<float> taker{level.coefficients(), level.inverse_diagonal.data(), level.b.data(),
                                     level.u.data(), level.r.data()};
    for_each_cell(stream, "residual", level.box, AtIndex<ResidualTaker<float>>{level.box, taker});
}

void DeviceMultigrid::restrict_to(StreamRef stream, const Level& coarse, const Level& fine)
{
    Restrictor restrictor{fine.box, coarse.box, {}, {}, fine.r.data(), coarse.b.data()};
    for (int a = 0; a < 3; ++a)
    {
        restrictor.map[a] = fine.map(a);
        restrictor.open[a] = coarse.open[a].data();
    }
    for_each_cell(stream, "restrict", coarse.box, restrictor);
}

void DeviceMultigrid::prolong(StreamRef stream, const Level& fine, const Level& coarse)
{
    Prolongator prolongator{fine.box,     coarse.box, {}, {}, coarse.u.data(), fine.inverse_diagonal.data(),
                            fine.u.data()};
    for (int a = 0; a < 3; ++a)
    {
        prolongator.map[a] = fine.map(a);
        prolongator.open[a] = coarse.open[a].data();
    }
    for_each_cell(stream, "prolong", fine.box, prolongator);
}

void DeviceMultigrid::solve_coarsest(StreamRef stream, const Level& level)
{
    smooth_from_zero(stream, level);
    smooth(stream, level, 1);
    for (int i = 1; i < kCoarsestSmoothings; ++i)
        for (const int colour : {0, 1}) smooth(stream, level, colour);
    for (int i = 0; i < kCoarsestSmoothings; ++i)
        for (const int colour : {1, 0}) smooth(stream, level, colour);
}

void DeviceMultigrid::queue_cycle(StreamRef stream, std::size_t index) const
{
    const Level& level = levels_[index];
    if (index + 1 == levels_.size()) return solve_coarsest(stream, level);
    smooth_from_zero(stream, level);
    smooth(stream, level, 1);
    for (int i = 1; i < kSmoothings; ++i)
        for (const int colour : {0, 1}) smooth(stream, level, colour);
    take_residual(stream, level);
    restrict_to(stream, levels_[index + 1], level);
    queue_cycle(stream, index + 1);
    prolong(stream, level, levels_[index + 1]);
    for (int i = 0; i < kSmoothings; ++i)
        for (const int colour : {1, 0}) smooth(stream, level, colour);
}

}  // namespace spindrift::gpu
