// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "core/backend.h"

namespace spindrift::cpu
{

/// Writes a snapshot beside `file` and renames it when it is whole. Throws Error if the disk does not take
/// it.
void write_snapshot(const Snapshot& snapshot, const std::filesystem::path& file);

/// Throws Error for a file that is missing, foreign, of another version, truncated or damaged.
Snapshot read_snapshot(const std::filesystem::path& file);

}  // namespace spindrift::cpu
