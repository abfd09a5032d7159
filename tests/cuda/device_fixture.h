// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

namespace spindrift::gpu
{

/// Base of every test that needs a device: without one it skips, saying why; with SPINDRIFT_REQUIRE_CUDA=1 it
/// fails.
class DeviceTest : public testing::Test
{
  protected:
    void SetUp() override;
};

}  // namespace spindrift::gpu
