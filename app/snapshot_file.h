// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <filesystem>

#include "core/backend.h"

namespace spindrift::app
{

/// A Snapshot and the state hash that it must restore to.
struct StoredSnapshot
{
    Snapshot snapshot;
    std::uint64_t state_hash = 0;
};

/// CBOR (RFC 8949); arrays as byte strings in the machine's order, little-endian on every supported machine.
/// Whole or not at all.
void write_snapshot(const std::filesystem::path& file, const StoredSnapshot& stored);

/// Throws Error for a file that is missing, truncated, of another kind or inconsistent.
StoredSnapshot read_snapshot(const std::filesystem::path& file);

}  // namespace spindrift::app
