// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace spindrift::scene
{

enum class ChildFate
{
    returned,  ///< by the end of the function or by an exception
    crashed,
    took_too_long,
};

/// Runs a function in a forked copy of this process and tells what became of the copy; nothing else comes
/// back. Libraries that read files crash on some broken ones (HDF5 1.10 does on flipped bytes, assimp's
/// lesser importers too): who lets a copy read the file first can answer instead of dying. What the function
/// writes to the terminal is dropped. Without a way to fork: returned.
ChildFate try_in_child(const std::function<void()>& function, unsigned limit_s);

}  // namespace spindrift::scene
