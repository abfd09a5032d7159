// SPDX-License-Identifier: MIT
#include "cpu/snapshot_file.h"

#include <array>
#include <cstring>
#include <fstream>
#include <system_error>

#include <fmt/format.h>

#include "core/error.h"
#include "core/philox.h"

namespace spindrift::cpu
{

namespace
{

// Layout, little endian: header, emitter state (8 bytes each), eleven arrays (4 bytes each), checksum (8).
constexpr std::array<char, 8> kMagic = {'S', 'P', 'N', 'D', 'R', 'S', 'N', 'P'};
constexpr std::uint64_t kVersion = 1;
constexpr std::uint64_t kArrays = 11;

struct Header
{
    std::array<char, 8> magic;
    std::uint64_t version;
    std::uint64_t world_hash, step, next_id;
    std::uint64_t emitted, alive, left, landed, vanished, withheld;
    std::uint64_t emitter_words, arrays, flakes;
};
static_assert(sizeof(Header) == 14 * 8);

/// Running checksum over 4-byte words.
class Checksum
{
  public:
    void add(const void* data, std::size_t bytes)
    {
        const auto* p = static_cast<const unsigned char*>(data);
        for (std::size_t i = 0; i + 4 <= bytes; i += 4)
        {
            std::uint32_t word = 0;
            std::memcpy(&word, p + i, 4);
            value_ = mix64(value_ ^ word) + 0x9E3779B97F4A7C15U;
        }
    }
    std::uint64_t value() const { return value_; }

  private:
    std::uint64_t value_ = 0;
};

class Writer
{
  public:
    explicit Writer(const std::filesystem::path& file)
        : file_(file), out_(file, std::ios::binary | std::ios::trunc)
    {
        if (!out_)
            throw Error(
                fmt::format("{}: cannot be written; choose a folder that takes files", file.string()));
    }
    void put(const void* data, std::size_t bytes)
    {
        sum_.add(data, bytes);
        out_.write(static_cast<const char*>(data), static_cast<std::streamsize>(bytes));
    }
    void finish()
    {
        const std::uint64_t sum = sum_.value();
        out_.write(reinterpret_cast<const char*>(&sum), sizeof sum);
        out_.close();
        if (!out_)
            throw Error(
                fmt::format("{}: could not be written whole (disk full?); free some space", file_.string()));
    }

  private:
    std::filesystem::path file_;
    std::ofstream out_;
    Checksum sum_;
};

class Reader
{
  public:
    explicit Reader(const std::filesystem::path& file) : file_(file)
    {
        std::error_code error;
        if (!std::filesystem::is_regular_file(file, error))
            throw Error(
                fmt::format("{}: is not a file; give a snapshot that spindrift wrote", file.string()));
        bytes_left_ = std::filesystem::file_size(file, error);
        in_.open(file, std::ios::binary);
        if (error || !in_)
            throw Error(fmt::format("{}: cannot be read; check its permissions", file.string()));
    }
    void get(void* data, std::size_t bytes)
    {
        if (bytes > bytes_left_ || !in_.read(static_cast<char*>(data), static_cast<std::streamsize>(bytes)))
            fail("ends too early (truncated); write it again");
        bytes_left_ -= bytes;
        sum_.add(data, bytes);
    }
    void finish()
    {
        const std::uint64_t expected = sum_.value();
        std::uint64_t stored = 0;
        get(&stored, sizeof stored);
        if (stored != expected) fail("is damaged (its checksum does not fit); write it again");
        if (bytes_left_ != 0) fail("has more bytes than a snapshot (damaged); write it again");
    }
    std::uint64_t bytes_left() const { return bytes_left_; }
    [[noreturn]] void fail(const char* problem) const
    {
        throw Error(fmt::format("{}: snapshot {}", file_.string(), problem));
    }

  private:
    std::filesystem::path file_;
    std::ifstream in_;
    std::uint64_t bytes_left_ = 0;
    Checksum sum_;
};

Header header_of(const Snapshot& s)
{
    Header h{};
    h.magic = kMagic, h.version = kVersion;
    h.world_hash = s.world_hash, h.step = s.step, h.next_id = s.next_id;
    h.emitted = s.counts.emitted, h.alive = s.counts.alive, h.left = s.counts.left;
    h.landed = s.counts.landed, h.vanished = s.counts.vanished, h.withheld = s.counts.withheld;
    h.emitter_words = s.emitter_state.size();
    h.arrays = s.arrays.size();
    h.flakes = s.arrays.empty() ? 0 : s.arrays.front().size();
    return h;
}

Header read_header(Reader& in)
{
    Header h{};
    in.get(&h, sizeof h);
    if (h.magic != kMagic)
        in.fail("has not the mark of one (foreign file); give a file that spindrift wrote");
    if (h.version != kVersion) in.fail("is of another version; write it again with this program");
    if (h.arrays != kArrays) in.fail("has not eleven arrays (damaged); write it again");
    // each factor is checked alone, so that the product cannot wrap
    const std::uint64_t left = in.bytes_left();
    if (h.emitter_words > left / 8 || h.flakes > left / (4 * kArrays) ||
        8 * h.emitter_words + 4 * kArrays * h.flakes + 8 != left)
        in.fail("has not the size that its head states (truncated or damaged); write it again");
    return h;
}

}  // namespace

void write_snapshot(const Snapshot& s, const std::filesystem::path& file)
{
    std::filesystem::path aside = file;
    aside += ".part";
    try
    {
        Writer out(aside);
        const Header h = header_of(s);
        out.put(&h, sizeof h);
        out.put(s.emitter_state.data(), 8 * s.emitter_state.size());
        for (const auto& array : s.arrays) out.put(array.data(), 4 * array.size());
        out.finish();
        std::filesystem::rename(aside, file);
    }
    catch (const std::filesystem::filesystem_error&)
    {
        std::error_code ignored;
        std::filesystem::remove(aside, ignored);
        throw Error(fmt::format("{}: cannot be written; choose a file name that is free", file.string()));
    }
    catch (const Error&)
    {
        std::error_code ignored;
        std::filesystem::remove(aside, ignored);
        throw;
    }
}

Snapshot read_snapshot(const std::filesystem::path& file)
{
    Reader in(file);
    const Header h = read_header(in);
    Snapshot s;
    s.world_hash = h.world_hash, s.step = h.step, s.next_id = h.next_id;
    s.counts = {h.emitted, h.alive, h.left, h.landed, h.vanished, h.withheld};
    s.emitter_state.resize(h.emitter_words);
    in.get(s.emitter_state.data(), 8 * s.emitter_state.size());
    s.arrays.assign(kArrays, std::vector<std::uint32_t>(h.flakes));
    for (auto& array : s.arrays) in.get(array.data(), 4 * array.size());
    in.finish();
    return s;
}

}  // namespace spindrift::cpu
