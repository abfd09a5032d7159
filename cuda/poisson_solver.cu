// SPDX-License-Identifier: MIT
#include "cuda/poisson_solver.h"

#include <optional>

#include "cuda/device_multigrid.h"
#include "cuda/poisson_kernels.cuh"

namespace spindrift::gpu
{

namespace
{

struct Square
{
    const double* v;
    __device__ double operator()(std::ptrdiff_t i) const { return v[i] * v[i]; }
};

struct ScaleResidual
{
    const double* r;
    double scale;
    float* to;
    __device__ void operator()(std::size_t i) const { to[i] = static_cast<float>(r[i] * scale); }
};

struct TimesResult
{
    const double* r;
    const float* z;
    __device__ double operator()(std::ptrdiff_t i) const { return r[i] * static_cast<double>(z[i]); }
};

struct NextDirection
{
    const float* z;
    double beta;
    double* p;
    __device__ void operator()(std::size_t i) const { p[i] = static_cast<double>(z[i]) + beta * p[i]; }
};

struct TakeImage
{
    FaceCoefficients c;
    const double* p;
    double* image;
    __device__ double operator()(std::ptrdiff_t i) const
    {
        image[i] = c.outflow(p, i);
        return image[i] * p[i];
    }
};

struct Advance
{
    double alpha;
    const double *p, *image;
    double *x, *r;
    __device__ double operator()(std::ptrdiff_t i) const
    {
        x[i] += alpha * p[i];
        r[i] -= alpha * image[i];
        return r[i] * r[i];
    }
};

class DeviceSolver final : public PoissonSolver
{
  public:
    explicit DeviceSolver(const PoissonProblem& problem)
        : DeviceSolver(problem, poisson_levels(problem), std::nullopt)
    {
    }
    DeviceSolver(const PoissonProblem& problem, StreamRef stream)
        : DeviceSolver(problem, poisson_levels(problem), stream)
    {
    }

    const PaddedBox& box() const override { return box_; }
    FaceCoefficients coefficients() const override
    {
        return {face_[0].data(), face_[1].data(), face_[2].data(), box_.row(), box_.plane()};
    }

  private:
    DeviceSolver(const PoissonProblem& problem, std::vector<PoissonLevel> levels,
                 std::optional<StreamRef> stream)
        : stream_(stream.value_or(own_stream_.ref())),
          box_(levels.front().box),
          cells_(static_cast<std::size_t>(box_.count())),
          side_m_{DeviceBuffer<double>(problem.side_m[0]), DeviceBuffer<double>(problem.side_m[1]),
                  DeviceBuffer<double>(problem.side_m[2])},
          multigrid_(stream_, levels),
          sums_(box_),
          b_(cells_),
          x_(cells_),
          r_(cells_),
          p_(cells_),
          image_(cells_),
          face_(std::move(levels.front().face))
    {
    }

    double begin(const std::vector<double>& b) override
    {
        for (const DeviceBuffer<double>* array : {&b_, &r_})
            copy_to_device(stream_, array->data(), b.data(), cells_);
        for (const DeviceBuffer<double>* array : {&x_, &p_, &image_})
            check(cudaMemsetAsync(array->data(), 0, array->bytes(), stream_.get()), "cudaMemsetAsync");
        return sums_.sum(stream_, "b.b", Square{b_.data()});
    }

    double precondition(double scale) override
    {
        launch(stream_, "scale residual", cells_,
               ScaleResidual{r_.data(), scale, multigrid_.right_hand_side()});
        multigrid_.cycle(stream_);
        return sums_.sum(stream_, "r.z", TimesResult{r_.data(), multigrid_.result()});
    }

    double turn(double beta) override
    {
        launch(stream_, "next direction", cells_, NextDirection{multigrid_.result(), beta, p_.data()});
        return sums_.sum(stream_, "p.Ap", TakeImage{multigrid_.coefficients(), p_.data(), image_.data()});
    }

    double advance(double alpha) override
    {
        return sums_.sum(stream_, "advance", Advance{alpha, p_.data(), image_.data(), x_.data(), r_.data()});
    }

    double sweep(int sweeps, double factor) override
    {
        const FaceCoefficients c = multigrid_.coefficients();
        const float* inverse = multigrid_.inverse_diagonal();
        const Smoother<double> smoother{c, inverse, b_.data(), x_.data(), factor};
        for (int done = 0; done < sweeps; ++done)
            for (const int colour : {0, 1}) smooth_colour(stream_, box_, smoother, colour);
        const ResidualTaker<double> taker{c, inverse, b_.data(), x_.data(), r_.data()};
        for_each_cell(stream_, "residual", box_, AtIndex<ResidualTaker<double>>{box_, taker});
        return sums_.sum(stream_, "r.r", Square{r_.data()});
    }

    double largest_per_volume() const override
    {
        return sums_.largest(
            stream_, "largest residual",
            LargestPerVolume{box_, side_m_[0].data(), side_m_[1].data(), side_m_[2].data(), r_.data()});
    }

    void end(std::vector<double>& x) override
    {
        x.resize(cells_);
        copy_to_host(stream_, x.data(), x_.data(), cells_);
        stream_.wait();
    }

    Stream own_stream_;
    StreamRef stream_;
    PaddedBox box_;
    std::size_t cells_;
    std::array<DeviceBuffer<double>, 3> side_m_;
    DeviceMultigrid multigrid_;
    mutable RowSums sums_;
    DeviceBuffer<double> b_, x_, r_, p_, image_;  ///< image: A p
    std::array<std::vector<float>, 3> face_;      ///< on the host
};

}  // namespace

std::unique_ptr<PoissonSolver> make_poisson_solver(const PoissonProblem& problem)
{
    return std::make_unique<DeviceSolver>(problem);
}

std::unique_ptr<PoissonSolver> make_poisson_solver(const PoissonProblem& problem, StreamRef stream)
{
    return std::make_unique<DeviceSolver>(problem, stream);
}

}  // namespace spindrift::gpu
