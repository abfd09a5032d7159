// SPDX-License-Identifier: MIT
#include "app/snapshot_file.h"

#include <bit>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/error.h"
#include "image/whole_file.h"

namespace spindrift::app
{

namespace
{

using nlohmann::json;

static_assert(std::endian::native == std::endian::little,
              "snapshots hold arrays in the machine's byte order");

constexpr const char* kKind = "spindrift snapshot 1";
constexpr std::size_t kArrays = 11;

json to_json(const FlakeCounts& c)
{
    return {{"emitted", c.emitted}, {"alive", c.alive},       {"left", c.left},
            {"landed", c.landed},   {"vanished", c.vanished}, {"withheld", c.withheld}};
}

FlakeCounts counts_from(const json& j)
{
    return {j.at("emitted"), j.at("alive"), j.at("left"), j.at("landed"), j.at("vanished"), j.at("withheld")};
}

template <class T>
json::binary_t to_binary(const std::vector<T>& values)
{
    std::vector<std::uint8_t> bytes(values.size() * sizeof(T));
    if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
    return json::binary_t(std::move(bytes));
}

template <class T>
std::vector<T> from_binary(const json& j)
{
    const auto& bytes = j.get_binary();
    if (bytes.size() % sizeof(T) != 0) throw Error("an array ends inside an element");
    std::vector<T> values(bytes.size() / sizeof(T));
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

StoredSnapshot from_json(const json& j)
{
    if (j.at("kind") != kKind) throw Error("it is of another kind or version");
    StoredSnapshot stored;
    stored.state_hash = j.at("state_hash");
    Snapshot& s = stored.snapshot;
    s.world_hash = j.at("world_hash");
    s.step = j.at("step");
    s.next_id = j.at("next_id");
    s.counts = counts_from(j.at("counts"));
    s.emitter_state = from_binary<std::uint64_t>(j.at("emitter_state"));
    for (const json& array : j.at("arrays")) s.arrays.push_back(from_binary<std::uint32_t>(array));
    if (s.arrays.size() != kArrays)
        throw Error(fmt::format("it holds {} arrays, not {}", s.arrays.size(), kArrays));
    for (const auto& array : s.arrays)
        if (array.size() != s.counts.alive)
            throw Error(
                fmt::format("an array holds {} flakes, not the {} alive", array.size(), s.counts.alive));
    return stored;
}

}  // namespace

void write_snapshot(const std::filesystem::path& file, const StoredSnapshot& stored)
{
    const Snapshot& s = stored.snapshot;
    json arrays = json::array();
    for (const auto& array : s.arrays) arrays.push_back(to_binary(array));
    const json j = {{"kind", kKind},
                    {"state_hash", stored.state_hash},
                    {"world_hash", s.world_hash},
                    {"step", s.step},
                    {"next_id", s.next_id},
                    {"counts", to_json(s.counts)},
                    {"emitter_state", to_binary(s.emitter_state)},
                    {"arrays", std::move(arrays)}};
    const std::vector<std::uint8_t> bytes = json::to_cbor(j);
    image::write_whole(file, std::as_bytes(std::span(bytes)));
}

StoredSnapshot read_snapshot(const std::filesystem::path& file)
{
    const std::vector<std::byte> bytes = image::read_whole(file);
    try
    {
        return from_json(
            json::from_cbor(std::span(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size())));
    }
    catch (const json::exception& e)
    {
        throw Error(
            fmt::format("{}: is no whole Spindrift snapshot ({}); give a file that --save-snapshot wrote",
                        file.string(), e.what()));
    }
    catch (const Error& e)
    {
        throw Error(
            fmt::format("{}: is no usable Spindrift snapshot: {}; give a file that --save-snapshot wrote",
                        file.string(), e.what()));
    }
}

}  // namespace spindrift::app
