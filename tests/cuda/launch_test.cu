// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>

#include <vector>

#include "core/error.h"
#include "cuda/buffer.h"
#include "cuda/launch.cuh"
#include "tests/cuda/device_fixture.h"

namespace spindrift::gpu
{

namespace
{

struct CountVisit
{
    std::uint32_t* visits;
    __device__ void operator()(std::size_t i) const { atomicAdd(&visits[i], 1U); }
};

struct Nothing
{
    __device__ void operator()() const {}
};

class Launch : public DeviceTest, public testing::WithParamInterface<std::size_t>
{
  protected:
    std::vector<std::uint32_t> visits(const DeviceBuffer<std::uint32_t>& buffer)
    {
        std::vector<std::uint32_t> host(buffer.size());
        check(cudaMemcpy(host.data(), buffer.data(), buffer.bytes(), cudaMemcpyDeviceToHost), "cudaMemcpy");
        return host;
    }
};

TEST_P(Launch, VisitsEachIndexOnce)
{
    const std::size_t n = GetParam();
    const Stream stream;
    const DeviceBuffer<std::uint32_t> buffer(std::vector<std::uint32_t>(n + 1));
    launch(stream, "visits", n, CountVisit{buffer.data()});
    stream.ref().wait();
    std::vector<std::uint32_t> expected(n + 1, 1);
    expected.back() = 0;
    EXPECT_EQ(visits(buffer), expected);
}

TEST_P(Launch, TakesTheCountFromTheDevice)
{
    const auto n = static_cast<std::uint32_t>(GetParam());
    const Stream stream;
    const DeviceBuffer<std::uint32_t> count(std::vector<std::uint32_t>{n});
    const DeviceBuffer<std::uint32_t> buffer(std::vector<std::uint32_t>(n + 1));
    launch_counted(stream, "visits", count.data(), std::size_t{n} + 1, CountVisit{buffer.data()});
    stream.ref().wait();
    std::vector<std::uint32_t> expected(n + 1, 1);
    expected.back() = 0;
    EXPECT_EQ(visits(buffer), expected);
}

INSTANTIATE_TEST_SUITE_P(Sizes, Launch,
                         testing::Values(0, 1, 31, 32, 33, 255, 256, 257, 4095, 4096, 4097, 104729));

using LaunchErrors = DeviceTest;

TEST_F(LaunchErrors, NameTheKernelAndTheCodeAndDoNotStick)
{
    const Stream stream;
    try
    {
        launch_blocks(stream, "too wide", 1, 4096, Nothing{});
        FAIL() << "a block of 4096 threads was launched";
    }
    catch (const Error& error)
    {
        EXPECT_THAT(error.what(), testing::AllOf(testing::HasSubstr("too wide"), testing::HasSubstr("4096"),
                                                 testing::HasSubstr("cudaError")));
    }
    EXPECT_EQ(cudaGetLastError(), cudaSuccess);
}

}  // namespace

}  // namespace spindrift::gpu
