// SPDX-License-Identifier: MIT
#include "cpu/snapshot_file.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>
#include <unistd.h>

#include "core/error.h"
#include "worlds.h"

namespace spindrift::cpu::test
{
namespace
{

class SnapshotFile : public testing::Test
{
  protected:
    SnapshotFile()
        : folder(std::filesystem::temp_directory_path() / ("spindrift-snapshot-" + std::to_string(getpid()))),
          file(folder / "run.snap"),
          run(world_with_everything(3000, OnLeave::respawn, true))
    {
        std::filesystem::create_directories(folder);
        run.steps(20);
    }
    ~SnapshotFile() override { std::filesystem::remove_all(folder); }
    std::string bytes() const
    {
        std::ifstream in(file, std::ios::binary);
        return {std::istreambuf_iterator<char>(in), {}};
    }
    void put(const std::string& text) const { std::ofstream(file, std::ios::binary) << text; }

    std::filesystem::path folder, file;
    TestRun run;
};

TEST_F(SnapshotFile, GivesBackWhatItTook)
{
    write_snapshot(run->save(), file);
    EXPECT_FALSE(std::filesystem::exists(file.string() + ".part"));
    TestRun other(world_with_everything(3000, OnLeave::respawn, true));
    other->restore(read_snapshot(file));
    EXPECT_EQ(other->state_hash(), run->state_hash());
    run.steps(10);
    other.steps(10);
    EXPECT_EQ(other->state_hash(), run->state_hash());
}

TEST_F(SnapshotFile, IsRefusedWhenCutAnywhere)
{
    write_snapshot(run->save(), file);
    const std::string whole = bytes();
    for (const std::size_t keep : {std::size_t{0}, std::size_t{5}, std::size_t{100}, std::size_t{200},
                                   whole.size() / 2, whole.size() - 1})
    {
        put(whole.substr(0, keep));
        EXPECT_THROW(read_snapshot(file), Error) << keep << " bytes";
    }
    put(whole + "x");
    EXPECT_THROW(read_snapshot(file), Error);
}

TEST_F(SnapshotFile, IsRefusedWhenAnyByteChanged)
{
    write_snapshot(run->save(), file);
    const std::string whole = bytes();
    for (std::size_t i = 0; i < whole.size(); i += whole.size() / 97 + 1)
    {
        std::string damaged = whole;
        damaged[i] = static_cast<char>(damaged[i] ^ 0x10);
        put(damaged);
        EXPECT_THROW(read_snapshot(file), Error) << "byte " << i;
    }
}

TEST_F(SnapshotFile, IsRefusedWhenForeignMissingOrAFolder)
{
    put(std::string(5000, 'a'));
    EXPECT_THROW(read_snapshot(file), Error);
    EXPECT_THROW(read_snapshot(folder / "nothing"), Error);
    EXPECT_THROW(read_snapshot(folder), Error);
    EXPECT_THROW(write_snapshot(run->save(), folder / "no" / "such"), Error);
    EXPECT_THROW(write_snapshot(run->save(), folder), Error);
}

TEST_F(SnapshotFile, FitsOnlyItsOwnWorld)
{
    World other = world_with_everything(3000, OnLeave::respawn, true);
    other.wind.cells[40].w += 0.001F;
    TestRun stranger(other);
    EXPECT_THROW(stranger->restore(run->save()), Error);
}

TEST_F(SnapshotFile, IsRefusedWhenItContradictsItself)
{
    const Snapshot good = run->save();
    Snapshot bad = good;
    bad.arrays[0].pop_back();
    EXPECT_THROW(run->restore(bad), Error);
    bad = good;
    bad.arrays[2][5] = 0x7FC00000;  // NaN
    EXPECT_THROW(run->restore(bad), Error);
    bad = good;
    bad.arrays[10][5] = 200U << 8;  // an emitter that is not there
    EXPECT_THROW(run->restore(bad), Error);
    bad = good;
    bad.emitter_state.pop_back();
    EXPECT_THROW(run->restore(bad), Error);
    const std::uint64_t before = run->state_hash();
    run->restore(good);
    EXPECT_EQ(run->state_hash(), before);
}

}  // namespace
}  // namespace spindrift::cpu::test
