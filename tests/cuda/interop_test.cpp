// SPDX-License-Identifier: MIT
// Whether OpenGL and CUDA share memory, what happens where they cannot, and that the reasons are kept.
#include <gmock/gmock.h>

#include <array>
#include <memory>
#include <string>

#include "core/error.h"
#include "cuda/buffer.h"
#include "cuda/interop/gl_device.h"
#include "cuda/interop/probe.h"
#include "cuda/interop/registered_buffers.h"
#include "cuda/interop/sharing.h"
#include "gl/context.h"
#include "gl/object.h"
#include "tests/cuda/device_fixture.h"
#include "tests/cuda/failing_calls.h"

namespace spindrift::gpu
{

namespace
{

using testing::AllOf;
using testing::AnyOf;
using testing::HasSubstr;
using testing::Not;
using Which = FailingCalls::Which;

/// Tests in which no GL context is current.
class WithoutGl : public DeviceTest
{
};

/// Tests that have one, each its own.
class Interop : public DeviceTest
{
  protected:
    void SetUp() override
    {
        DeviceTest::SetUp();
        if (IsSkipped() || HasFatalFailure()) return;
        context_ = make_context_beside_cuda();
        errors_before_ = gl::Context::debug_errors();
    }
    void TearDown() override
    {
        EXPECT_EQ(cudaPeekAtLastError(), cudaSuccess) << "an error was left behind";
        EXPECT_EQ(gl::Context::debug_errors(), errors_before_);
    }

    std::unique_ptr<gl::Context> context_;
    std::string errors_before_;
};

/// What Error says; empty if nothing is thrown.
template <class Function>
std::string error_of(const Function& function)
{
    try
    {
        function();
    }
    catch (const Error& error)
    {
        return error.what();
    }
    return {};
}

TEST_F(WithoutGl, SharingIsRefusedWithTheReasonAndNoErrorStays)
{
    const Sharing sharing = find_sharing(SharingWish::automatic);
    EXPECT_FALSE(sharing.shared);
    EXPECT_THAT(sharing.because, AllOf(HasSubstr("cudaErrorInvalidGraphicsContext (219"),
                                       HasSubstr("no OpenGL context is current")));
    EXPECT_EQ(cudaPeekAtLastError(), cudaSuccess);
}

TEST_F(WithoutGl, InsistingIsAnError)
{
    EXPECT_THAT(error_of([] { find_sharing(SharingWish::on); }),
                AllOf(HasSubstr("--interop on"), HasSubstr("219"), HasSubstr("--interop auto or off"),
                      HasSubstr("docs/troubleshooting.md"), Not(HasSubstr("\n"))));
    EXPECT_EQ(cudaPeekAtLastError(), cudaSuccess);
}

TEST_F(Interop, ProbeGoesThroughBothAndLeavesNothing)
{
    const FailingCalls calls;
    EXPECT_EQ(probe_interop(calls.calls()), "");
    EXPECT_EQ(calls.counts().registered, 1);
    EXPECT_EQ(calls.counts().unregistered, 1);
    EXPECT_EQ(calls.counts().unmap_calls, 1);
    EXPECT_EQ(calls.counts().unregistered_after_gl_freed, 0);
}

TEST_F(Interop, SharingNamesDeviceAndRenderer)
{
    const Sharing sharing = find_sharing(SharingWish::on);
    EXPECT_TRUE(sharing.shared);
    int current = -1;
    ASSERT_EQ(cudaGetDevice(&current), cudaSuccess);
    EXPECT_EQ(sharing.device, current);
    EXPECT_THAT(sharing.because, AllOf(HasSubstr("probed"), HasSubstr(context_->info().renderer)));
    EXPECT_THAT(describe(sharing), HasSubstr("in place"));
}

TEST_F(Interop, OffCopiesAndSaysWho)
{
    const Sharing sharing = find_sharing(SharingWish::off);
    EXPECT_FALSE(sharing.shared);
    EXPECT_THAT(sharing.because, HasSubstr("--interop off"));
    EXPECT_THAT(describe(sharing), HasSubstr("page-locked"));
}

TEST_F(Interop, ABufferThatGlFreedIsRefused)
{
    GLuint name = gl::make_lent_buffer(64, nullptr).name();  // freed at once
    const std::array<GLuint, 1> names{name};
    EXPECT_THAT(error_of([&] { const RegisteredBuffers registered(names); }),
                HasSubstr("cudaGraphicsGLRegisterBuffer failed"));
}

TEST_F(Interop, AFailedSecondRegistrationUndoesTheFirst)
{
    const gl::Buffer first = gl::make_lent_buffer(64, nullptr);
    const gl::Buffer second = gl::make_lent_buffer(64, nullptr);
    const std::array<GLuint, 2> names{first.name(), second.name()};
    const FailingCalls calls(Which::registering, cudaErrorOperatingSystem, 1);
    EXPECT_THAT(error_of([&] { const RegisteredBuffers registered(names, calls.calls()); }),
                HasSubstr("304"));
    EXPECT_EQ(calls.counts().registered, 1);
    EXPECT_EQ(calls.counts().unregistered, 1);
}

TEST_F(Interop, AnExceptionWhileMappedUnmapsAndUnregisters)
{
    const gl::Buffer buffer = gl::make_lent_buffer(64, nullptr);
    const std::array<GLuint, 1> names{buffer.name()};
    const Stream stream;
    const FailingCalls calls;
    EXPECT_THROW(
        {
            RegisteredBuffers registered(names, calls.calls());
            registered.map(stream);
            throw Error("a kernel could not be launched");
        },
        Error);
    EXPECT_EQ(calls.counts().unmap_calls, 1);
    EXPECT_EQ(calls.counts().unregistered, 1);
}

TEST_F(Interop, AProbeThatLandsElsewhereIsNoticed)
{
    const DeviceBuffer<std::uint32_t> elsewhere(kProbeWords);
    FailingCalls calls;
    calls.misdirect_kernels(elsewhere.data());
    EXPECT_THAT(probe_interop(calls.calls()), HasSubstr("word 0 is 0x"));
    const Sharing sharing = find_sharing(SharingWish::automatic, calls.calls());
    EXPECT_FALSE(sharing.shared);
    EXPECT_THAT(sharing.because, HasSubstr("came back wrong"));
}

struct Failure
{
    const char* name;
    Which which;
    cudaError_t code;
    const char* shows;  ///< in the reason
};

void PrintTo(const Failure& failure, std::ostream* out)
{
    *out << failure.name;
}

class InteropFailure : public Interop, public testing::WithParamInterface<Failure>
{
};

TEST_P(InteropFailure, IsTheReasonAndTheCopyTakesOver)
{
    const Failure& failure = GetParam();
    FailingCalls calls(failure.which, failure.code);
    Sharing sharing = find_sharing(SharingWish::automatic, calls.calls());
    EXPECT_FALSE(sharing.shared);
    EXPECT_THAT(sharing.because,
                AllOf(HasSubstr(failure.shows), HasSubstr(context_->info().renderer), Not(HasSubstr("\n"))));
    EXPECT_EQ(calls.counts().registered, calls.counts().unregistered);

    // The copy works although the driver has just failed.
    const auto memory = make_drawn_memory(100, SharingWish::automatic, sharing, calls.calls());
    const Stream stream;
    const FlakeAddresses at = memory->map(stream);
    stream.ref().wait();  // mapped for this stream only
    const std::array<std::uint64_t, 2> pairs{7, 3};
    const std::array<float, 8> x{0, 1, 2, 3, 4, 5, 6, 7};
    copy_to_device_now(at.draw_list.pairs, pairs.data(), pairs.size());
    copy_to_device_now(at.flakes.x, x.data(), x.size());
    memory->hand_over(stream, 8, {false, 2, 0, true});
    memory->unmap(stream);
    std::array<float, 2> drawn{};
    glGetNamedBufferSubData(memory->drawn_from().state_buffer(), 0, sizeof(drawn), drawn.data());
    EXPECT_EQ(drawn, (std::array<float, 2>{7, 3}));
}

TEST_P(InteropFailure, IsAnErrorForWhoInsists)
{
    const Failure& failure = GetParam();
    const FailingCalls calls(failure.which, failure.code);
    EXPECT_THAT(error_of([&] { find_sharing(SharingWish::on, calls.calls()); }),
                AllOf(HasSubstr("--interop on"), HasSubstr(failure.shows), Not(HasSubstr("\n"))));
}

INSTANTIATE_TEST_SUITE_P(
    Codes, InteropFailure,
    testing::Values(
        Failure{"other_gpu", Which::registering, cudaErrorOperatingSystem, "cudaErrorOperatingSystem (304"},
        Failure{"wsl", Which::registering, cudaErrorUnknown, "cudaErrorUnknown (999"},
        Failure{"unlike_numbers", Which::registering, cudaErrorInvalidDevice, "cudaErrorInvalidDevice (101"},
        Failure{"virtual_gl", Which::devices, cudaErrorUnknown,
                "cudaGLGetDevices failed: cudaErrorUnknown (999"},
        Failure{"no_cuda_behind_gl", Which::devices, cudaErrorNoDevice, "cudaErrorNoDevice (100"},
        Failure{"cannot_map", Which::mapping, cudaErrorMapBufferObjectFailed,
                "cudaGraphicsMapResources failed"},
        Failure{"no_address", Which::addresses, cudaErrorUnknown,
                "cudaGraphicsResourceGetMappedPointer failed"},
        Failure{"cannot_unmap", Which::unmapping, cudaErrorUnmapBufferObjectFailed,
                "cudaGraphicsUnmapResources failed"}),
    [](const auto& made) { return std::string(made.param.name); });

TEST_F(Interop, AContextOnNoCudaDeviceIsRefused)
{
    FailingCalls calls;
    calls.name_device(FailingCalls::kNoDevice);
    const Sharing sharing = find_sharing(SharingWish::automatic, calls.calls());
    EXPECT_FALSE(sharing.shared);
    EXPECT_THAT(sharing.because, HasSubstr("none of its devices"));
}

TEST_F(Interop, ADeviceThatCudaDoesNotKnowIsRefused)
{
    FailingCalls calls;
    calls.name_device(12345);
    const Sharing sharing = find_sharing(SharingWish::automatic, calls.calls());
    EXPECT_FALSE(sharing.shared);
    EXPECT_FALSE(sharing.device);
    // an EGL that names its own device disagrees before CUDA is asked
    EXPECT_THAT(sharing.because, AllOf(HasSubstr("12345"), AnyOf(HasSubstr("cudaErrorInvalidDevice (101"),
                                                                 HasSubstr("EGL draws on CUDA device"))));
}

TEST_F(Interop, RegistrationThatFailsAfterTheProbeFallsBack)
{
    const FailingCalls calls(Which::registering, cudaErrorMemoryAllocation, 1);
    Sharing sharing = find_sharing(SharingWish::automatic, calls.calls());
    ASSERT_TRUE(sharing.shared);
    EXPECT_NE(make_drawn_memory(100, SharingWish::automatic, sharing, calls.calls()), nullptr);
    EXPECT_FALSE(sharing.shared);
    EXPECT_THAT(sharing.because, HasSubstr("cudaErrorMemoryAllocation"));
}

TEST_F(Interop, RegistrationThatFailsAfterTheProbeIsAnErrorForWhoInsists)
{
    const FailingCalls calls(Which::registering, cudaErrorMemoryAllocation, 1);
    Sharing sharing = find_sharing(SharingWish::on, calls.calls());
    EXPECT_THAT(error_of([&] { make_drawn_memory(100, SharingWish::on, sharing, calls.calls()); }),
                HasSubstr("--interop on"));
}

}  // namespace

}  // namespace spindrift::gpu
