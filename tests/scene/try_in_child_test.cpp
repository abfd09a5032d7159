// SPDX-License-Identifier: MIT
#include "scene/try_in_child.h"

#include <gtest/gtest.h>

#include <csignal>
#include <stdexcept>

namespace spindrift::scene
{
namespace
{

TEST(TryInChild, TellsWhatBecameOfTheCopy)
{
    EXPECT_EQ(try_in_child([] {}, 10), ChildFate::returned);
    EXPECT_EQ(try_in_child([] { throw std::runtime_error("no"); }, 10), ChildFate::returned);
    EXPECT_EQ(try_in_child([] { std::raise(SIGSEGV); }, 10), ChildFate::crashed);
    EXPECT_EQ(try_in_child([] { std::abort(); }, 10), ChildFate::crashed);
    EXPECT_EQ(try_in_child([] { std::raise(SIGALRM); }, 10), ChildFate::took_too_long);
}

TEST(TryInChild, ChangesNothingHere)
{
    int value = 1;
    try_in_child([&] { value = 2; }, 10);
    EXPECT_EQ(value, 1);
}

}  // namespace
}  // namespace spindrift::scene
