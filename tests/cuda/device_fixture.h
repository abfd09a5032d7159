// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

namespace spindrift::gpu
{

/// For SetUp(): without a device the test is skipped, saying why; with SPINDRIFT_REQUIRE_CUDA=1 it fails.
void require_device();

/// Base of tests that need a device.
class DeviceTest : public testing::Test
{
  protected:
    void SetUp() override { require_device(); }
};

}  // namespace spindrift::gpu
